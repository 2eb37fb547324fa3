"""The report of a run of a scene: one page, with pictures that move, that needs nothing beside it.

scene     what the FMU says about itself in its modelDescription.xml
result    one run of it, wherever it comes from
simulate  a run with fmpy
linear    critical speeds and modes, from the JSON of `cargo xtask campbell`
measure   numbers taken from the run
stations  places along the axis and how they move
turns     the motion turn by turn: orbits, whirls, orders
spectrum  its frequencies
paper     the claims of the paper and the exact answer for its rotor
machine   what the drawing of the rotor needs
panels    the pictures, as data; vibration and attitude have theirs, plots the forms of plots
findings  the results that stand first
page      everything on one HTML page; web/ has its template, style sheet and scripts, and uPlot
deliver   the report, a summary, and whether the energy adds up
pack      curves as compact JSON
notation  how numbers are written
"""
