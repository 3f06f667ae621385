"""Options: by their names in Python, in SI units, and what is said where one is wrong."""

import pickle

import numpy as np
import pytest

import dashpot
from dashpot import _options

pytestmark = pytest.mark.filterwarnings("ignore::dashpot.DashpotWarning")
KEY = "padding.peak-force"
FOAM = dashpot.Scene(
    text="""
[nodes]
head = { mass = "5 kg", drop = "75 cm" }
[elements]
liner = { between = ["head", "ground"], spring = "20 kN/m", thickness = "3 cm", area = "60 cm^2" }
[run]
duration = "40 ms"
"""
)


@pytest.mark.parametrize(
    "work",
    [
        lambda: dashpot.sweep("reference", {"head.velocity": [1.0]}, metod="bdf"),
        lambda: dashpot.run("reference", metod="bdf"),
        lambda: dashpot.rheometer("reference:padding", metod="bdf"),
        lambda: dashpot.Scene("reference").run(metod="bdf"),
        lambda: dashpot.call("cost", "reference", metod="bdf"),
    ],
)
def test_an_unknown_option_names_the_closest(work):
    with pytest.raises(TypeError, match="no option 'metod': did you mean 'method'"):
        work()


def test_faults_of_options_name_them_as_python_does():
    with pytest.raises(dashpot.SceneError) as found:
        dashpot.sweep("reference", {"head.velocity": [1.0]}, method="eksact")
    (fault,) = found.value.faults
    assert fault["message"] == "invalid value 'eksact' for `method`"
    assert "'exact'" in fault["help"] and "tr-bdf2" in fault["help"]
    with pytest.raises(dashpot.SceneError) as found:
        dashpot.call("run", "reference", at=7.0, out="none")
    assert found.value.faults[0]["message"].startswith('`at="7 s"` lies beyond')
    with pytest.raises(dashpot.SceneError, match="runn") as found:
        dashpot.call("runn", "reference")
    assert "`run`" in found.value.faults[0]["help"]


def test_a_verb_without_an_object_says_so():
    with pytest.raises(TypeError, match="`dashpot list` has no `--json`"):
        dashpot.call("list", "methods")


def test_an_unknown_number_names_those_that_there_are():
    for value in (1.0, "1 m/s"):
        with pytest.raises(dashpot.SceneError) as found:
            dashpot.run("reference", {"head.velocit": value})
        assert "`head.velocity`" in found.value.faults[0]["help"]


def test_arguments_in_another_order_are_told(tmp_path):
    grid = {"head.velocity": [1.0]}
    with pytest.raises(TypeError, match="folder.*path, not a dict.*folder, vary"):
        dashpot.sweep_to_parquet("reference", grid, tmp_path / "points")
    with pytest.raises(TypeError, match="vary.*dictionary.*not a list"):
        dashpot.sweep("reference", [KEY], grid)


@pytest.mark.parametrize("stress", [[5e3, 1e4], np.array([5e3, 1e4]), ["5 kPa", 1e4], (5000, "10 kPa")])
def test_lists_are_taken_where_the_command_takes_them(stress):
    listed = dashpot.cushion(FOAM, stress=stress, heights=[0.3, 0.6])
    assert listed == dashpot.cushion(FOAM, stress="5 kPa, 10 kPa", heights="30 cm, 60 cm")


def test_numbers_have_the_unit_of_their_option():
    own = dashpot.vibrate("reference", drive="ground", from_=10.0, to=np.float64(1e3), points=np.int64(5))
    assert own == dashpot.vibrate("reference", drive="ground", **{"from": "10 Hz"}, to="1 kHz", points=5)


def test_numbers_are_in_si_units_whatever_they_measure(tmp_path):
    drop = tmp_path / "drop.csv"
    times = np.arange(0.0, 0.04, 1e-4)
    pulse = 2.0 + 900.0 * np.sin(np.pi * np.clip((times - 0.01) / 0.01, 0.0, 1.0))
    np.savetxt(drop, np.column_stack([times, pulse]), delimiter=",", header="t [s],acc [m/s^2]", comments="")
    own = dashpot.signal(str(drop), offset=2.0)
    assert own["channels"] == dashpot.signal(str(drop), offset="2 m/s^2")["channels"]
    assert own["channels"] != dashpot.signal(str(drop))["channels"]
    shaken = {"drive": "ground", "at": 20.0}
    plain = dashpot.vibrate("reference", amplitude=1e-3, **shaken)
    assert plain["steady"] == dashpot.vibrate("reference", amplitude="1 mm", **shaken)["steady"]
    plain = dashpot.rheometer("reference:padding", test="relaxation", with_={"rise": 1e-4})
    assert plain["tests"] == dashpot.rheometer("reference:padding", test="relaxation", with_={"rise": "0.1 ms"})["tests"]


def test_faults_of_studies_name_options_as_python_does():
    with pytest.raises(dashpot.SceneError, match="`points`: a whole number is wanted"):
        dashpot.vibrate("reference", drive="ground", points=2.5)
    with pytest.raises(dashpot.SceneError, match="no unit: write"):
        dashpot.rheometer("reference:padding", with_={"hold": "5"})
    with pytest.raises(dashpot.SceneError, match="eksact"):
        dashpot.rheometer("reference:padding", method="eksact")
    with pytest.raises(TypeError):
        dashpot.vibrate("reference", drive="ground", of=[object()])


def test_what_a_study_cannot_take_is_refused():
    with pytest.raises(dashpot.SceneError, match="`at`: it takes an `amplitude`"):
        dashpot.vibrate("reference", drive="ground", at=3.0)
    with pytest.raises(dashpot.SceneError, match="takes scene, and options by name; 2 were given"):
        dashpot.vibrate("reference", "reference", drive="ground")
    with pytest.raises(dashpot.SceneError, match="takes first and second"):
        dashpot.compare("reference:padding")
    with pytest.raises(TypeError, match="`from` takes one value, not 2"):
        dashpot.vibrate("reference", drive="ground", from_=[1.0, 2.0])


def test_values_of_a_test_stand_side_by_side():
    listed = dashpot.rheometer("reference:padding", test="relaxation", with_={"rise": [1e-4, "0.2 ms"]})
    texts = dashpot.rheometer("reference:padding", test="relaxation", with_={"rise": "0.1 ms,0.2 ms"})
    assert len(listed["tests"]) == 2
    assert [own["settings"] for own in listed["tests"]] == [own["settings"] for own in texts["tests"]]


def test_a_study_writes_a_folder_as_the_command_does(tmp_path):
    found = dashpot.vibrate("reference", drive="ground", set="head.mass=12 kg", out=str(tmp_path / "shaken"))
    assert (tmp_path / "shaken" / "report.html").is_file()
    assert found == dashpot.vibrate("reference", drive="ground", set={"head.mass": 12.0})
    assert list(found)[:3] == ["dashpot", "title", "file"]


def test_a_study_of_a_scene_in_memory_and_of_one_that_is_named_is_the_same():
    scene = dashpot.Scene("reference")
    assert dashpot.vibrate(scene, drive="ground")["responses"] == dashpot.vibrate("reference", drive="ground")["responses"]
    assert dashpot.call("vibrate", "reference", drive="ground") == dashpot.vibrate("reference", drive="ground")
    heavy = dashpot.vibrate("reference", drive="ground", set={"head.mass": 20.0})
    assert heavy["modes"] == dashpot.vibrate("reference", drive="ground", set={"head.mass": "20 kg"})["modes"]
    assert heavy["modes"] != dashpot.vibrate("reference", drive="ground")["modes"]


def test_numbers_that_are_set_are_in_si_units():
    scene = dashpot.Scene(text='[values]\nstiffness = "80 kN/m"\n' + FOAM.text.replace('"20 kN/m"', '"stiffness"'))
    modes = [dashpot.vibrate(scene, drive="ground", set={"stiffness": value})["modes"] for value in ("40 kN/m", 40e3, "80 kN/m")]
    assert modes[0] == modes[1] != modes[2]


def test_the_text_of_a_scene_is_no_path():
    with pytest.raises(ValueError, match=r"Scene\(text="):
        dashpot.vibrate(FOAM.text)


def test_names_that_mean_the_same_are_known_by_each_other():
    with pytest.raises(TypeError, match="did you mean 'set'"):
        dashpot.vibrate("reference", drive="ground", values={"head.mass": 20.0})


def test_mixed_values_are_swept():
    own = dashpot.sweep("reference", {"head.velocity": ["4 m/s", 5.0]}, [KEY])
    assert (own.parameters["head.velocity"] == [4.0, 5.0]).all()


def test_one_key_is_a_text():
    assert list(dashpot.run("reference", measures=KEY)) == [KEY]


def test_a_wrong_key_of_a_pickled_report_is_not_solved_for():
    report = dashpot.run("reference", method="exact", measures=KEY)
    again = pickle.loads(pickle.dumps(report))
    with pytest.raises(KeyError, match=KEY):
        again["padding.peak-forse"]
    assert "_again" not in vars(again._own)
    # What was not asked for is there all the same.
    assert again["padding.impulse"].value == report["padding.impulse"].value
    assert "_again" not in vars(again._own)


def test_words_of_the_command_that_are_no_options_stay() -> None:
    for text in ("to pass '--foo' as a value, use '-- --foo'", "unexpected argument '--Foo' found"):
        assert _options.in_python("run", text) == text
