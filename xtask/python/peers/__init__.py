"""What a user would pick instead, measured like the FMU: one file a peer, run as `python -m peers.<name>`.

Each reads a task as JSON from the standard input and prints a JSON line for every setting that it tried.

task       what is asked, how it is timed, and what is answered
equations  the rotor as a system of first-order equations, for those that solve such
"""
