"""Tells in what two recordings differ."""

import csv
import difflib
import gzip
import json
import re
from collections import Counter, defaultdict
from pathlib import Path

SPAN = r"\d[\d.]*(?:e-?\d+)?\s+(?:ns|µs|ms|s|min)\b"
# What carries wall times: the verb, kinds of parts, a region of the text, and what is taken out of it.
MASKS = [
    ("", "err", r"^note: [a-z]+: \d+ % after .*\n(?:  .*\n)*", r"[\s\S]+"),
    ("", "dashpot-files", r"^\d+-[0-9a-f]{16} ", r".+"),
    ("run", "out html", r"further runs?\s+in\s+\S+\s+\S+", r"[\s\S]+"),
    ("run", "out", r"^  .*\bmethod\b.* (?:time|in all)\n(?:  .*\n)*", SPAN + "| +"),
    ("run", "html", r"<table(?:(?!</table>)[\s\S])*>(?:in all|largest error)<(?:(?!</table>)[\s\S])*", SPAN),
    ("cost", "out", r"^  \S+ +(?:1e-\d+|–) .*$", SPAN + r"|[\d.]+ %| +"),
    ("cost", "out", r"^(?:The cheapest|For .*cheapest)[\s\S]*", r"[\s\S]+"),
    ("cost", "html svg", r"\A[\s\S]+", r"[\s\S]+"),
]
# Differences that are times, by verb, kind and place.
TIMES = re.compile(r"cost (?:json .*\.(?:time_s|integration_s)\b|json \$\.cheapest|csv \$\.(?:time|integration)\b)")
MOST_LINES = 4000  # of longer texts the n-th lines are compared
MOST_PLACES = 60

Difference = tuple[str, str]  # a place, such as a path, and what differs there


def of_json(old: object, new: object, path: str = "$") -> list[Difference]:
    if isinstance(old, dict) and isinstance(new, dict):
        differences = [(path, "order of keys")] if old.keys() == new.keys() and list(old) != list(new) else []
        differences += [(f"{path}.{key}", "gone") for key in old if key not in new]
        differences += [(f"{path}.{key}", "new") for key in new if key not in old]
        pairs = [(f"{path}.{key}", value, new[key]) for key, value in old.items() if key in new]
    elif isinstance(old, list) and isinstance(new, list):
        differences = [(path, f"{len(old)} → {len(new)} items")] if len(old) != len(new) else []
        pairs = [(f"{path}[{at}]", *pair) for at, pair in enumerate(zip(old, new))]
    elif old == new and type(old) is type(new):
        return []
    else:
        what = " → ".join(json.dumps(value, ensure_ascii=False)[:80] for value in (old, new))
        if {type(old), type(new)} <= {int, float} and old != new:
            what += f" (relative {abs(new - old) / max(abs(old), abs(new)):.1e})"
        return [(path, what)]
    return differences + [item for place, *pair in pairs for item in of_json(*pair, place)]


def columns(text: str) -> dict[str, list[str]]:
    """The cells of a table by the headings of its columns."""
    head, *rows = csv.reader(text.splitlines())
    return {name: [row[at] for row in rows if at < len(row)] for at, name in enumerate(head)}


def of_text(old: str, new: str) -> list[Difference]:
    """Differences by lines; each tag of a page stands on a line of its own."""
    sides = [text.replace("><", ">\n<").split("\n") for text in (old, new)]
    if max(map(len, sides)) <= MOST_LINES:
        lines = list(difflib.unified_diff(*sides, lineterm="", n=0))[2:]
        return [("", line) for line in lines if not line.startswith("@@")]
    pairs = [(f"-{one}", f"+{two}") for one, two in zip(*sides) if one != two]
    return [("", f"{len(sides[0])} → {len(sides[1])} lines"), *(("", line) for pair in pairs for line in pair)]


def of_part(verb: str, kind: str, old: str, new: str) -> list[Difference]:
    if old == new:
        return []
    if kind in ("json", "csv"):
        read = json.loads if kind == "json" else columns
        differences = of_json(read(old), read(new)) or [("", "written otherwise")]
        return [(place, what) for place, what in differences if not TIMES.match(f"{verb} {kind} {place}")]
    for of, kinds, region, inner in MASKS:
        if of in ("", verb) and kind in kinds.split():
            mask = re.compile(region, re.MULTILINE)
            old, new = (mask.sub(lambda found: re.sub(inner, "", found[0]), text) for text in (old, new))
    return of_text(old, new) if old != new else []


def parts(entry: dict) -> dict[str, tuple[str, str]]:
    """All that is kept of a command: the name of each part, with its kind and text."""
    named = {}
    for name in ("text", "json"):
        if run := entry.get(name):
            is_table = re.match(r"[^ \n].*\S,\S.*,\S.*\n", run["out"])
            kind = "json" if run["out"].startswith("{") else "csv" if is_table else "out"
            named |= {f"{name} code": ("code", str(run["code"])), f"{name} out": (kind, run["out"])}
            named[f"{name} err"] = ("err", run["err"])
            named |= {f"{name} {file}": (file.rpartition(".")[2], text) for file, text in run["files"].items()}
    return named


def of_command(old: dict, new: dict) -> list[tuple[str, str, Difference]]:
    """The part, its kind and the difference, for each difference of a command."""
    verb, sides, differences = old["command"].split()[0], (parts(old), parts(new)), []
    for name in dict.fromkeys([*sides[0], *sides[1]]):
        one, two = (side.get(name) for side in sides)
        if one and two and one[0] == two[0]:
            differences += [(name, one[0], item) for item in of_part(verb, one[0], one[1], two[1])]
        else:
            what = "new" if not one else "gone" if not two else f"is {two[0]} now"
            differences.append((name, (one or two)[0], ("", what)))
    return differences


def compare(old: Path, new: Path, allow: list[str], lines: int) -> int:
    """Prints the differences and how many parts of each kind differ; 1 if there are any that are not allowed."""
    sides = [{str(path.relative_to(root)): path for path in sorted(root.rglob("*.gz"))} for root in (old, new)]
    compared, changed, places, differing, dropped = Counter(), defaultdict(set), Counter(), 0, 0
    for key in dict.fromkeys([*sides[0], *sides[1]]):
        pair = [json.loads(gzip.decompress(side[key].read_bytes())) for side in sides if key in side]
        title = f"{key.split('/')[0]}/{pair[0]['command']}"
        missing = ("command", "command", ("", "new" if key in sides[1] else "gone"))
        compared.update(kind for kind, _ in parts(pair[0]).values())
        kept = defaultdict(list)
        for part, kind, (place, what) in of_command(*pair) if len(pair) == 2 else [missing]:
            if any(re.search(pattern, f"{title}: {part}: {place} {what}") for pattern in allow):
                dropped += 1
                continue
            kept[part].append(f"{place}: {what}" if place else what)
            changed[kind].add((key, part))
            if place:
                what = what if what in ("gone", "new") else "differs"
                places[re.sub(r"\[\d+\]", "[]", f"{kind} {place} {what}")] += 1
        differing += bool(kept)
        if kept:
            print(f"\n{title}")
        for part, items in kept.items():
            print(f"  {part}: {len(items)} differences", *(item[:200] for item in items[:lines]), sep="\n    ")
    print(f"\n{len(sides[0])} and {len(sides[1])} commands, {differing} differ; {dropped} differences are allowed")
    for kind in sorted(compared | Counter(changed.keys())):
        print(f"  {kind:14}{compared[kind]:6} parts, {len(changed[kind]):5} differ")
    print(*(f"  {count:6} × {place}" for place, count in places.most_common(MOST_PLACES)), sep="\n")
    return int(differing > 0)
