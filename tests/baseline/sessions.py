"""The commands: each session is a folder with scenes and data, in which its commands run in order."""

import re
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FENCE = re.compile(r"^```(.*)\n((?:.*\n)*?)^```$", re.MULTILINE)
AT_ONCE = 33  # scenes in a session of the campaign


@dataclass
class Session:
    name: str
    data: Path | None = None
    steps: list[tuple[str, str]] = field(default_factory=list)  # a file and its text, or "" and a command
    folders: bool = True  # whether what is run with `--json` writes a folder as well

    def files(self) -> list[tuple[str, str]]:
        return [step for step in self.steps if step[0]]


def chapter(path: Path) -> Session:
    """The files and commands of a chapter, by the rules of `tests/it/docs/shown.rs` and `readme.rs`."""
    data = path.parent / "data"
    session = Session(str(path.relative_to(ROOT)), data if data.is_dir() else None)
    for kind, block in FENCE.findall(path.read_text()):
        word, _, name = kind.partition(" ")
        if path == ROOT / "README.md" and kind == "toml" and not session.files():
            name = "pad.toml"
        if word == "toml" and name.endswith(".toml"):
            session.steps.append((name, block))
        elif kind == "console" or block.startswith("$ dashpot "):
            for line in re.findall(r"^(?:\$ )?dashpot (.*)$", block, re.MULTILINE):
                line = re.split(r"\s+[#|>]", line)[0].replace(',99999"', ',999"')
                session.steps.append(("", line.strip()))
    return session


def listed() -> list[Session]:
    """The sessions of `commands.txt`: a heading is `[NAME]` or `[NAME with the files of CHAPTER]`."""
    sessions = []
    for line in (Path(__file__).parent / "commands.txt").read_text().splitlines():
        if heading := re.fullmatch(r"\[(.*?)(?: with the files of (.*))?\]", line):
            other = chapter(ROOT / heading[2]) if heading[2] else Session("")
            sessions.append(Session(heading[1], other.data, other.files()))
        elif line and not line.startswith("#"):
            before, choices, after = re.fullmatch(r"(.*?)(?:\{(.*)\})?([^{}]*)", line).groups()
            sessions[-1].steps += [("", f"{before}{one}{after}") for one in (choices or "").split("|")]
    return sessions


def scenes(chapters: list[Session]) -> list[Session]:
    """Scenes of the campaign, of the corpus and of chapters, each of which is solved and explained."""
    entries = (ROOT / "tests/it/campaign/scenes.txt").read_text().split("### ")[1:]
    named = [entry.split("---\n")[0].split("\n", 1) for entry in entries]
    drawn = [(name.replace(" ", "-") + ".toml", text) for name, text in named]
    groups = {f"campaign {at // AT_ONCE}": (None, drawn[at : at + AT_ONCE]) for at in range(0, len(drawn), AT_ONCE)}
    corpus = sorted((ROOT / "tests/corpus/networks").glob("*.toml"))
    groups["corpus"] = (None, [(path.name, path.read_text()) for path in corpus])
    groups |= {f"scenes of {page.name}": (page.data, page.files()) for page in chapters if page.files()}
    sessions = [Session(name, *group, False) for name, group in groups.items()]
    for session in sessions:
        run = "run --method auto,bdf" if session.name.startswith("campaign") else "run"
        for name, text in session.files():
            verbs = [run, "explain --verbose", "check"] if "[nodes]" in text else ["check"]
            session.steps += [("", f"{verb} {name}") for verb in verbs]
    return sessions


def sessions() -> list[Session]:
    paths = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    chapters = [session for session in map(chapter, paths) if len(session.steps) > len(session.files())]
    return chapters + listed() + scenes(chapters)
