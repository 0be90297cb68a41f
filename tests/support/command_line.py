"""What the tests of the command line share."""

import sys

SOUND = """\
model block
parameter M = 1
state v = 1
M*der(v) = -0.5*sgn(v)
approximate sgn1: K = 1e5, beta = 4e-3
"""
REFUSED = "model block\nparameter u = 1\nstate v = 1\nder(v) = -w*sgn(v)\n"
NSODE = [sys.executable, "-P", "-m", "nsode"]
