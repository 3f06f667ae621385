"""Runs the commands and keeps what they print and write: one compressed JSON object for each."""

import glob
import gzip
import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from sessions import ROOT, Session, sessions

FOLDERS = "run rheometer cost signal sweep merge design cushion fit vibrate thesis".split()
JSON = [*FOLDERS, "compare", "groups"]
FOR_TEXTS = re.compile(r" --(?:json|curves|csv|(?:table|plot) \w+)\b")  # what `--json` excludes
ENVIRONMENT = {"PATH": os.defpath, "LC_ALL": "C.UTF-8", "TZ": "UTC", "COLUMNS": "80", "NO_COLOR": "1", "TERM": "dumb"}
LIMIT = 300  # seconds for one command
LONG = 20  # seconds from which on a command is named


def text(raw: bytes, folder: Path) -> str:
    """The text, with the temporary folder under a fixed name; what is no text by its digest."""
    try:
        return raw.decode().replace(str(folder), "FOLDER")
    except UnicodeDecodeError:
        return f"{len(raw)} bytes, sha256 {hashlib.sha256(raw).hexdigest()}"


def state(folder: Path) -> dict[str, tuple[int, ...]]:
    stats = {path: path.stat() for path in folder.rglob("*") if path.is_file()}
    return {str(path.relative_to(folder)): (found.st_mtime_ns, found.st_ino) for path, found in stats.items()}


def run(binary: Path, words: list[str], folder: Path) -> dict:
    """One command: its exit code, both streams, and the files that are new or written again."""
    before = state(folder)
    streams = {"stdin": subprocess.DEVNULL, "capture_output": True, "timeout": LIMIT}
    environment = ENVIRONMENT | {"HOME": str(folder)}
    done = subprocess.run(["dashpot", *words], executable=binary, cwd=folder, env=environment, **streams)
    changed = sorted(name for name, found in state(folder).items() if before.get(name) != found)
    files = {name: text((folder / name).read_bytes(), folder) for name in changed}
    return {"code": done.returncode, "out": text(done.stdout, folder), "err": text(done.stderr, folder), "files": files}


def with_json(words: list[str], folders: bool) -> list[str]:
    """The command with `--json`, without what that excludes, and with a folder `json-…` for what it writes."""
    words = [*shlex.split(FOR_TEXTS.sub("", shlex.join(words))), "--json"]
    if "--out" in words:
        at = words.index("--out") + 1
        words[at] = f"json-{words[at]}"
    elif folders and words[0] in FOLDERS:
        words += ["--out", "json-out"]
    return words


def both(binary: Path, line: str, folder: Path, folders: bool) -> dict:
    """The command as it stands and, where the verb has it, with `--json`."""
    words = [name for word in shlex.split(line) for name in sorted(glob.glob(word, root_dir=folder)) or [word]]
    entry = {"command": line, "text": run(binary, words, folder)}
    if words[0] in JSON and "--help" not in words:
        entry["json"] = run(binary, with_json(words, folders), folder)
        for path in folder.glob("json-*"):
            shutil.rmtree(path) if path.is_dir() else path.unlink()
    return entry


def run_session(binary: Path, session: Session, target: Path) -> int:
    """Runs all commands of a session; their number."""
    place = target / re.sub(r"[^\w.]+", "-", session.name)
    place.mkdir(parents=True)
    lines: list[str] = []
    with tempfile.TemporaryDirectory(prefix="baseline-") as name:
        folder = Path(name).resolve()
        shutil.copytree(ROOT / "scenes", folder / "scenes")
        if session.data:
            shutil.copytree(session.data, folder / "data")
        for file, step in session.steps:
            if file:
                (folder / file).write_text(step)
                continue
            start = time.monotonic()
            entry = both(binary, step, folder, session.folders)
            if (seconds := time.monotonic() - start) > LONG:
                print(f"{seconds:.0f} s: {session.name}: {step}", flush=True)
            lines.append(step)
            digest = hashlib.sha256(f"{step} {lines.count(step)}".encode()).hexdigest()[:10]
            raw = json.dumps(entry, ensure_ascii=False).encode()
            (place / f"{step.split()[0]}-{digest}.json.gz").write_bytes(gzip.compress(raw, 5, mtime=0))
    return len(lines)


def record(binary: Path, folder: Path, session: str) -> int:
    """Records all sessions with this part in their names, two at a time."""
    if folder.exists():
        raise SystemExit(f"{folder} exists")
    chosen, start = [choice for choice in sessions() if session in choice.name], time.monotonic()
    with ThreadPoolExecutor(2) as pool:
        counts = list(pool.map(lambda choice: run_session(binary.resolve(), choice, folder), chosen))
    print(f"{sum(counts)} commands in {len(chosen)} sessions, {time.monotonic() - start:.0f} s")
    return 0
