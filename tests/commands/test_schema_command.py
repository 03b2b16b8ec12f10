"""``schema``: the schema by which an editor completes problem files."""

from __future__ import annotations

import tomllib
from pathlib import Path

import jsonschema
import msgspec
from click.testing import CliRunner, Result
from doors import ExitCode, cli
from worked import PROBLEMS


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, args)


def test_the_schema_is_printed_and_written_once(tmp_path: Path) -> None:
    path = tmp_path / "planmethod.schema.json"
    printed = run("schema")
    assert printed.exit_code == ExitCode.DONE
    assert run("schema", str(path)).exit_code == ExitCode.DONE
    assert path.read_text(encoding="utf-8") == printed.output
    again = run("schema", str(path))
    assert again.exit_code == ExitCode.USAGE
    assert "--force" in again.output


def test_it_takes_a_shipped_file_and_no_key_of_strangers() -> None:
    schema = msgspec.json.decode(run("schema").output)
    text = (PROBLEMS / "linkages" / "ex3.toml").read_text(encoding="utf-8")
    problem = tomllib.loads(text)
    jsonschema.validate(problem, schema)
    problem["driver"]["omga"] = problem["driver"].pop("omega")
    judged = jsonschema.Draft202012Validator(schema).iter_errors(problem)
    assert any("omga" in fault.message for fault in judged)


def test_keys_are_described_in_the_requested_language() -> None:
    for lang, said in (("ru", "Угловое ускорение, 1/с²."), ("en", "Angular acceleration, 1/s².")):
        schema = msgspec.json.decode(run("schema", "--lang", lang).output)
        assert schema["$defs"]["driver"]["properties"]["epsilon"]["description"].startswith(said)
