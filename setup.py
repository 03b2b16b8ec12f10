"""Build of the wheel: the shipped problems go into the package; all else: pyproject.toml."""

from pathlib import Path
from shutil import copytree

from setuptools import setup
from setuptools.command.build_py import build_py


class BuildWithProblems(build_py):
    """Copies problems/ to planmethod/problems, where planmethod.problem.tasks looks for them."""

    def run(self) -> None:
        """Build, and copy; an editable install reads them where they lie."""
        super().run()
        if not self.editable_mode:
            target = Path(self.build_lib) / "planmethod" / "problems"
            copytree("problems", target, dirs_exist_ok=True)


setup(cmdclass={"build_py": BuildWithProblems})
