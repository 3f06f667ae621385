"""What the package says of itself."""

import ast
import inspect
import pathlib

import pytest

import dashpot
from dashpot import _dashpot, _studies

STUB = pathlib.Path(dashpot.__file__).with_name("_dashpot.pyi")


def described():
    for own in ast.parse(STUB.read_text()).body:
        if isinstance(own, ast.FunctionDef):
            yield own.name, None, own
        elif isinstance(own, ast.ClassDef):
            for inner in own.body:
                yield own.name, inner.name, inner


@pytest.mark.parametrize(("name", "member", "node"), list(described()))
def test_the_stub_says_what_the_engine_has(name, member, node):
    own = getattr(_dashpot, name)
    own = own if member in (None, "__init__") else getattr(own, member)
    is_property = any(getattr(one, "id", "") == "property" for one in node.decorator_list)
    assert inspect.isgetsetdescriptor(own) == is_property
    if not is_property and member not in ("__float__", "__init__"):
        wanted = [one.arg for one in [*node.args.args, *node.args.kwonlyargs] if one.arg != "self"]
        found = [one for one in inspect.signature(own).parameters if one != "self"]
        assert found == wanted


def test_the_engine_has_no_more_than_the_stub_says():
    known = {(name, member) for name, member, _ in described()}
    names = {own for own in dir(_dashpot) if not own.startswith("__")}
    assert names == {name for name, _ in known}
    for name in names:
        own = getattr(_dashpot, name)
        if inspect.isclass(own):
            members = {one for one in vars(own) if not one.startswith("__")}
            assert members == {m for n, m in known if n == name and not m.startswith("__")}


@pytest.mark.parametrize("name", dashpot.__all__)
def test_all_that_is_public_is_described(name):
    assert inspect.getdoc(getattr(dashpot, name))


def test_studies_have_their_options_as_arguments():
    assert pathlib.Path(_studies.__file__).with_suffix(".pyi").read_text() == _studies.stub()
    parameters = inspect.signature(dashpot.vibrate).parameters
    assert parameters["points"].default == 200 and parameters["from_"].kind is inspect.Parameter.KEYWORD_ONLY
    for name in ("compare", "rheometer", "vibrate"):
        # What the command has for its files and its terminal is no option of a study.
        named = set(inspect.signature(getattr(dashpot, name)).parameters)
        flags = {own[0].replace("-", "_") for own in _dashpot.options(name)}
        assert {one.rstrip("_") for one in named} >= flags - {"out", "json", "plot", "color", "strict"}
