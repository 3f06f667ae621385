"""Work past one machine, on Dask: ``dashpot sweep --shard`` on the workers, ``dashpot merge`` where it is called; fits
and designs of many scenes by `calls`.

    from dask.distributed import Client
    from dashpot.distributed import sweep

    with Client("scheduler:8786") as client:        # or Client(n_workers=2) on one machine
        swept = sweep(client, "pad.toml", {"K": "5..30 MN/m,1000,log"}, folder="/shared/sweep", shards=64)

The folder has to be seen by all workers and by the caller. It is the manifest: shards that are there and whole are
not solved again, so an interrupted sweep is resumed by the same call, and a lost worker costs its shard at most.
"""

from __future__ import annotations

import os
import pathlib
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from ._options import values as written
from ._scene import Scene, keys
from ._verbs import Result, Sweep, _called, call


def sweep(
    client: Any,
    scene: Any,
    vary: Mapping[str, Any],
    measures: str | list[str] | tuple[str, ...] = (),
    *,
    folder: str | os.PathLike[str],
    shards: int,
    retries: int = 2,
    progress: Callable[[int, int], object] | None = None,
    **options: Any,
) -> Sweep:
    """The sweep of `dashpot.sweep`, to the byte, with its shards mapped over the workers of a Dask client.

    Args:
        client: a ``dask.distributed.Client``.
        folder: is kept, with one folder for each shard.
        shards: into so many parts; some times the number of workers.
        retries: so often a shard that fails is tried again; one whose worker is lost is solved elsewhere.
        progress: is called with the numbers of shards that are done and of all.
    """
    jobs = _solve(client, scene, vary, measures, folder, shards, retries, progress, options)
    return Sweep(call("merge", *jobs))


def sweep_to_parquet(
    client: Any,
    scene: Any,
    vary: Mapping[str, Any],
    measures: str | list[str] | tuple[str, ...] = (),
    *,
    folder: str | os.PathLike[str],
    shards: int,
    retries: int = 2,
    progress: Callable[[int, int], object] | None = None,
    **options: Any,
) -> list[pathlib.Path]:
    """The points of a sweep of any size as Parquet, written by the workers of a Dask client; nothing is put together.

    Args:
        client, scene, vary, measures, folder, shards, retries, progress, options: as of `sweep`.

    Returns:
        The files in the order of the points, for DuckDB, polars, pandas or ``dask.dataframe.read_parquet``.
    """
    options |= {"parquet": True}
    jobs = _solve(client, scene, vary, measures, folder, shards, retries, progress, options)
    return [file for job in jobs for file in sorted(pathlib.Path(job).glob("points-*.parquet"))]


def calls(
    client: Any,
    jobs: Iterable[tuple[str, tuple[Any, ...], Mapping[str, Any]]],
    *,
    retries: int = 2,
    progress: Callable[[int, int], object] | None = None,
) -> list[Result]:
    """Fits, designs and other verbs of many scenes, each with the result of `dashpot.call`, in the order of the jobs.

    Args:
        client: a ``dask.distributed.Client``.
        jobs: of each the verb, its operands, and its options:
            ``("fit", (scene,), {"to": "drop-7.csv:head.acceleration"})``. Files have to be seen by all workers, under
            the same names.
        retries, progress: as of `sweep`.
    """
    asked = list(jobs)
    futures = client.map(_call, asked, pure=False, retries=retries)
    _told(futures, progress)
    return client.gather(futures)


def _call(job: tuple[str, tuple[Any, ...], Mapping[str, Any]]) -> Result:
    verb, operands, options = job
    return call(verb, *operands, **options)


def _told(futures: list[Any], progress: Callable[[int, int], object] | None) -> None:
    from dask.distributed import as_completed

    for done, future in enumerate(as_completed(futures), 1):
        future.result()
        if progress is not None:
            progress(done, len(futures))


def _solve(
    client: Any,
    scene: Any,
    vary: Mapping[str, Any],
    measures: str | list[str] | tuple[str, ...],
    folder: str | os.PathLike[str],
    shards: int,
    retries: int,
    progress: Callable[[int, int], object] | None,
    options: dict[str, Any],
) -> list[str]:
    """Solves what is not there yet; the folders of all shards."""
    own = scene if isinstance(scene, Scene) else Scene(scene)
    home = pathlib.Path(folder).absolute()
    home.mkdir(parents=True, exist_ok=True)
    text = home / "scene.toml"
    if own.files:
        raise ValueError(f"workers may not have {own.files[0]!r}: write its values into the scene")
    _write(text, own.text)
    asked = {"vary": {name: written(name, values, own) for name, values in vary.items()}}
    asked |= {"measure": keys(measures), **options}
    jobs = [(str(text), str(home / f"shard-{at}"), f"{at}/{shards}", asked) for at in range(1, shards + 1)]
    futures = client.map(_shard, jobs, pure=False, retries=retries)
    _told(futures, progress)
    return [job[1] for job in jobs]


def _shard(job: tuple[str, str, str, dict[str, Any]]) -> None:
    scene, folder, place, asked = job
    # It tells nothing where the shard was there already.
    _called("sweep", (scene,), {"out": folder, "shard": place, "threads": 1, **asked}, None)


def _write(path: pathlib.Path, text: str) -> None:
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        part = path.with_suffix(".part")
        part.write_text(text, encoding="utf-8")
        part.replace(path)
