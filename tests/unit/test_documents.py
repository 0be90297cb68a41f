"""Every JSON document that nsode writes has the form that its schema states."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

import nsode
from nsode.cli import run
from support import MODELS

SCHEMAS = Path(__file__).parents[1] / "schemas"
REFUSED = Path(__file__).parents[1] / "refused"


def validator(name: str) -> Draft202012Validator:
    schema = json.loads((SCHEMAS / f"{name}.json").read_text(encoding="utf-8"))
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


@pytest.mark.parametrize("model", MODELS, ids=lambda path: path.stem)
@pytest.mark.parametrize("friction", [None, "lugre"])
def test_the_description_of_the_c_has_its_form(model, friction):
    files = nsode.load(model).with_law(friction=friction).emit("c")
    validator("descriptor").validate(json.loads(files[f"{model.stem}.json"]))


def test_the_findings_of_a_check_have_their_form(capsys):
    models = [*MODELS, *sorted(REFUSED.glob("*.di"))]
    run(["check", "--format", "json", *map(str, models), "missing.di"])
    told = json.loads(capsys.readouterr().out)
    validator("check").validate(told)
    assert [file["ok"] for file in told["files"]].count(True) == len(MODELS)


@pytest.mark.parametrize("model", MODELS, ids=lambda path: path.stem)
def test_an_analysis_has_its_form(model, capsys):
    assert run(["analyze", "--format", "json", str(model)]) == 0
    validator("analysis").validate(json.loads(capsys.readouterr().out))
