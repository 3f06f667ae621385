"""The chapter on Python: its code runs, and prints what it says."""

import contextlib
import io
import pathlib
import re

import pytest

CHAPTER = pathlib.Path(__file__).parents[2] / "docs" / "python.md"
BLOCK = re.compile(r"```(python(?: cluster)?|text)\n(.*?)```", re.S)


@pytest.mark.filterwarnings("ignore")
def test_the_chapter_prints_what_it_says(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names, printed = {"folder": tmp_path / "shards", "__name__": "chapter"}, ""
    blocks = BLOCK.findall(CHAPTER.read_text(encoding="utf-8"))
    assert len(blocks) > 12
    for kind, text in blocks:
        if kind == "text":
            assert printed == text
            continue
        if kind == "python cluster":
            pytest.importorskip("distributed")
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            exec(compile(text, str(CHAPTER), "exec"), names)
        printed = out.getvalue()
