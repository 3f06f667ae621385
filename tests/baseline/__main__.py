"""What the command printed and wrote before a change of its structure, beside what it does after it.

`record` runs the commands of the README and of the chapters, those of `commands.txt`, and the scenes of the
campaign, of the corpus and of the chapters; SESSION is a part of a session's name. Of each command it keeps the exit
code, both streams and the files that were written; where the verb has `--json`, the command runs once more with it,
and with `--out` where it names no folder itself.

`compare` tells which commands differ and in what: JSON by path, CSV by column, texts and pages by lines. What carries
wall times is masked (`MASKS` and `TIMES` in `compare.py`). `--allow` takes out the differences whose line, as in
`session/command: part: place what`, has the pattern, a regular expression. Exit code 1 where anything else differs.

It judges no number, only whether it changed.
"""

import argparse
import sys
from pathlib import Path

import compare
import record

if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="baseline", description=__doc__)
    verbs = parser.add_subparsers(dest="verb", required=True)
    for verb, folders in {"record": ("BINARY", "FOLDER"), "compare": ("OLD", "NEW")}.items():
        options = verbs.add_parser(verb)
        for name in folders:
            options.add_argument(name.lower(), metavar=name, type=Path)
        if verb == "record":
            options.add_argument("session", metavar="SESSION", nargs="?", default="")
        else:
            options.add_argument("--allow", metavar="PATTERN", action="append", default=[])
            options.add_argument("--lines", type=int, default=6, help="lines that are shown of each part")
    given = vars(parser.parse_args())
    sys.exit({"record": record.record, "compare": compare.compare}[given.pop("verb")](**given))
