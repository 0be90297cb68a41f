"""How long the command line takes to start."""

from __future__ import annotations

import sys
from pathlib import Path

from measure import command, in_turns, table
from support import MODELS


def main() -> None:
    """Measure and print."""
    nsode = str(Path(sys.executable).with_name("nsode"))
    small = str(next(model for model in MODELS if model.stem == "dry_friction"))
    commands = {
        "python -c pass": command(sys.executable, "-c", "pass"),
        "nsode --help": command(nsode, "--help"),
        "nsode check dry_friction.di": command(nsode, "check", small),
    }
    times = in_turns(commands, 15)
    bare = times["python -c pass"]
    rows = [(name, f"{1e3 * t:.0f}", f"{t / bare:.1f}") for name, t in times.items()]
    table("Starting", ("command", "ms", "times bare python"), rows)
