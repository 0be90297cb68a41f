"""PREFIX.json describes what the C computes."""

import json
from hashlib import sha256

import nsode
from nsode.backends import Options, emit
from nsode.expr import IndexRange
from nsode.ode import Input, Parameter
from support import MODELS
from support.hand_built import column, ode

SPHERE = next(path for path in MODELS if path.stem == "rolling_sphere")


def described(scene, **options):
    options = Options(**options)
    return json.loads(emit("c", scene, options)[f"{options.prefix or scene.name}.json"])


def test_the_sphere_is_described_in_full():
    model = nsode.load(SPHERE)
    told = described(model.ode, prefix="ball", real="float")
    assert told["schema_version"] == 1
    assert told["generator"] == {"name": "nsode", "version": nsode.__version__}
    assert told["model"] == {
        "name": "rolling_sphere",
        "sha256": sha256(SPHERE.read_bytes()).hexdigest(),
    }
    assert (told["prefix"], told["real"]) == ("ball", "float")
    assert told["run"] == {"duration": 4.0, "step": 1e-3, "every": None, "method": "rk4"}
    states = {state["name"]: state for state in told["states"]}
    assert [state["index"] for state in told["states"]] == list(range(16))
    assert [name for name, state in states.items() if state["auxiliary"]] == [
        "N.e", "F.a.x", "F.a.y"
    ]  # fmt: skip
    assert states["v.x"]["unit"] == "m/s"
    parameters = {p["name"]: p for p in told["parameters"]}
    assert parameters["N.K"]["default"] == 1e5
    assert parameters["M"]["constant_of"] is None
    assert [y["name"] for y in told["outputs"]] == ["depth", "N", "F.x", "F.y"]
    assert {(a["name"], a["term"], a["equation"]) for a in told["auxiliary_states"]} == {
        ("N.e", "N", "(24)"), ("F.a.x", "F", "(18a)"), ("F.a.y", "F", "(18a)")
    }  # fmt: skip
    assert {"rk4", "heun", "euler"} <= {method["name"] for method in told["integrators"]}


def test_a_family_is_one_item_whatever_its_size():
    told = described(column(1000))
    assert told["states"][2] == {
        "name": "N.e", "index": 2000, "size": 1001, "unit": None, "auxiliary": False,
        "range": {"variable": "i", "first": 0, "last": 1000},
    }  # fmt: skip
    assert told["checks"] == [
        {"number": 0, "kind": "assume", "names": ["x"], "line": None, "text": "", "reason": ""}
    ]


def test_a_check_names_its_place_and_all_that_it_reads():
    text = "model m\nparameter b = 2\nparameter c = 1\nassume b >= (  # why\n  c)\nstate v = 1\n"
    told = described(nsode.loads(f"{text}der(v) = -(b - c)*sgn(v)").ode)["checks"]
    assert told[0] == {
        "number": 0, "kind": "assume", "names": ["b", "c"], "line": 4, "text": "b >= ( c)",
        "reason": "",
    }  # fmt: skip
    assert ["sgn1.K"] in [check["names"] for check in told]


def test_constants_and_auxiliary_states_have_the_units_of_their_element():
    places = [*(told := described(nsode.load(SPHERE).ode))["parameters"], *told["states"]]
    units = {place["name"]: place["unit"] for place in places}
    assert {name: unit for name, unit in units.items() if name[:2] in ("N.", "F.")} == {
        "N.K": "N/m", "N.alpha": "s", "N.beta": "s", "N.e": "m",
        "F.K": "N/m", "F.beta": "s", "F.a.x": "m", "F.a.y": "m",
    }  # fmt: skip
    bristles = described(nsode.load(SPHERE).with_law(friction="lugre").ode)["parameters"]
    assert {p["name"]: p["unit"] for p in bristles}["F.B"] == "kg/s"


def test_the_equation_of_an_auxiliary_state_is_that_of_its_law():
    bristles = described(nsode.load(SPHERE).with_law(friction="lugre").ode)["auxiliary_states"]
    assert {(a["name"], a["law"], a["equation"]) for a in bristles} == {
        ("N.e", "xiong2013", "(24)"), ("F.a.x", "lugre", "(12)"), ("F.a.y", "lugre", "(12)")
    }  # fmt: skip


def test_what_is_not_known_is_null():
    scene = ode(
        inputs=[Input("u")],
        parameters=[Parameter("k", (1.0, float("nan")), IndexRange("i", 1, 2))],
    )
    told = described(scene)
    assert told["inputs"][0]["default"] is None
    assert told["parameters"][0]["default"] == [1.0, None]


def test_the_same_model_gives_the_same_bytes():
    first, second = (emit("c", nsode.load(SPHERE).ode) for _ in range(2))
    assert first == second
