"""Notebooks: they run, and print what stands in them. ``DASHPOT_UPDATE=1`` writes what they print."""

import ast
import contextlib
import io
import json
import os
import pathlib

import pytest

NOTEBOOKS = sorted((pathlib.Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))


def shown(source, names):
    """What a cell prints, and the text of its last expression where it has one that is also shown rich."""
    body = ast.parse(source).body
    last = body.pop() if body and isinstance(body[-1], ast.Expr) else None
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(ast.Module(body, []), "cell", "exec"), names)
        value = None if last is None else eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    if hasattr(value, "_repr_html_"):
        assert "<" in value._repr_html_()
    return out.getvalue() + ("" if value is None else f"{value!r}\n")


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_prints_what_stands_in_it(path, tmp_path, monkeypatch):
    if path.stem.endswith("xarray"):
        pytest.importorskip("xarray")
    monkeypatch.chdir(tmp_path)
    notebook, names = json.loads(path.read_text(encoding="utf-8")), {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            text = shown("".join(cell["source"]), names).splitlines(keepends=True)
            if os.environ.get("DASHPOT_UPDATE"):
                cell["outputs"] = [{"name": "stdout", "output_type": "stream", "text": text}] if text else []
            assert [line for own in cell["outputs"] for line in own["text"]] == text
    if os.environ.get("DASHPOT_UPDATE"):
        path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def test_there_are_five():
    assert len(NOTEBOOKS) == 5
