"""The demo's report: run an FMU, measure the run, draw it, write it down.

scene     what the FMU says about itself in its modelDescription.xml
simulate  one run of it with fmpy
measure   numbers taken from the run
paper     the claims of the paper and the exact answer for its rotor
figures   the run as pictures
page      everything on one HTML page
notation  how numbers are written
"""
