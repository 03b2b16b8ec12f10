"""Try the built distributions as a user would: in clean environments, away from the repository.

``make dist`` builds the source distribution and the wheel and runs this script. Each is installed
from its file into an environment of its own. The program prints its version and runs the commands
of the README: a template, a sketch, numbers, sheets and a protocol; then it solves a shipped task.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
import venv
from pathlib import Path
from tempfile import TemporaryDirectory

COMMANDS = (
    "--version",
    "new six-link my.toml",
    "sketch my.toml",
    "solve my.toml",
    "sheet my.toml --stamp author=Иванов",
    "protocol my.toml -o out",
    "new linkages-2.1.45 task.toml",
    "solve task.toml --json",
)
"""Commands that an installed program must run: five of the README, and a shipped task.

Each begins where the one before ended.
"""

_INSTALL = ("-m", "pip", "install", "--quiet")


def tried(package: Path, folder: Path) -> None:
    """Install a package into a clean environment in a folder, and run the commands there.

    Raises
    ------
    subprocess.CalledProcessError
        Something ends with another exit code than 0.
    """
    home = folder / "environment"
    venv.create(home, with_pip=True)
    programs = home / ("Scripts" if os.name == "nt" else "bin")
    # The repository and the Python settings of its developer must not reach this environment.
    clean = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    pip: list[str | Path] = [programs / "python", *_INSTALL, package.resolve()]
    calls: list[list[str | Path]] = [pip]
    calls += [[programs / "planmethod", *line.split()] for line in COMMANDS]
    for words in calls:
        done = subprocess.run(words, cwd=folder, env=clean, capture_output=True, text=True)
        if done.returncode:
            sys.stderr.write(done.stdout + done.stderr)
            done.check_returncode()
        last = (done.stdout.splitlines() or [""])[-1][:70]
        print(" ".join(Path(str(word)).name for word in words), "→", last)


def main(folder: str) -> None:
    """Try the only wheel of a folder, and the only source distribution, which has the tests."""
    (wheel,), (source,) = Path(folder).glob("*.whl"), Path(folder).glob("*.tar.gz")
    with tarfile.open(source) as archive:
        names = archive.getnames()
    if not any("/tests/test_house.py" in name for name in names):
        sys.exit(f"{source.name} has no tests: see MANIFEST.in")
    for package in (wheel, source):
        with TemporaryDirectory(prefix="planmethod-") as name:
            tried(package, Path(name))
        print(f"{package.name} works")


if __name__ == "__main__":
    main(sys.argv[1])
