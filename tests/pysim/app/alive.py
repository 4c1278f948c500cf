"""Whether a process still runs."""

import time
from pathlib import Path


def alive(pid: int) -> bool:
    """After some seconds; one that has ended and nobody has asked for does not run."""
    begun = time.monotonic()
    while time.monotonic() - begun < 5:
        try:
            state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            return False
        if state == "Z":
            return False
        time.sleep(0.02)
    return True


PARENT = """
import os, subprocess, sys, time
child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)'])
open('begun', 'w').write(str(child.pid))
os.replace('begun', 'child')
time.sleep(60)
"""


def child(folder: Path) -> int:
    """Number of the process that PARENT has started in a folder."""
    begun = time.monotonic()
    while time.monotonic() - begun < 60:
        if (folder / "child").exists():
            return int((folder / "child").read_text())
        time.sleep(0.01)
    raise AssertionError("it has started nothing")
