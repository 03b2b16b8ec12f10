from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

# A slow machine is no failure, and a run is like the one before it.
settings.register_profile("planmethod", deadline=None, derandomize=True)
settings.load_profile("planmethod")


@pytest.fixture(scope="session", autouse=True)
def _no_config_of_the_developer(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """The tests read an empty config file, never that of who runs them; no warning is let pass."""
    empty = Path(tmp_path_factory.mktemp("config")) / "config.toml"
    empty.touch()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PLANMETHOD_CONFIG", str(empty))
        patch.setenv("PYTHONWARNINGS", "error")  # in processes that tests start, too
        yield
