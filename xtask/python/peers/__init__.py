"""What a user would pick instead, measured like the FMU: one file a peer, run as `python -m peers.<name>`.

Each reads a task as a line of JSON from the standard input and prints a JSON line for every setting that it tried. heyoka then runs
settings again as they are asked for, in turn with ours.

task       what is asked, how it is timed, and what is answered
equations  the rotor as a system of first-order equations, for those that solve such

ross, a program of beam elements, is not timed: it is compared with our linear view, and reads that instead of a task.
"""
