"""Times `Scene.run` of the reference scene from Python: what a call takes above the engine, and what a second thread brings.

The first is the median over ten thousand calls, from the end of one to the end of the next, less what the engine took
for it by its own clock; the warning that each gives is in it, and the end of the report before. The second stands
beside two processes, which share nothing: more than those gain, two threads cannot have on this machine. Waits are
those of a thread for another one; the processor's time of a run would rise if both fought over memory or locks.

    pip install .
    python3 benches/python/calls.py
"""

import os
import resource
import statistics
import time
import warnings
from concurrent.futures import ThreadPoolExecutor

import dashpot

CALLS, PART, ROUNDS = 10_000, 1_000, 9

warnings.simplefilter("ignore")
scene = dashpot.Scene("reference")


def work(count):
    for _ in range(count):
        scene.run()


def above():
    """What calls take above the engine, and the engine, in µs."""
    own, engine, before = [], [], time.perf_counter()
    for _ in range(CALLS):
        report = scene.run()
        now = time.perf_counter()
        own.append(now - before - report.wall)
        engine.append(report.wall)
        before = now
    return [1e6 * statistics.median(all) for all in (own, engine)]


def took(job):
    started = time.perf_counter()
    job()
    return time.perf_counter() - started


def threads():
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(work, [PART, PART]))


def processes():
    children = []
    for _ in range(2):
        child = os.fork()
        if child == 0:
            work(PART)
            os._exit(0)
        children.append(child)
    for child in children:
        os.waitpid(child, 0)


def used(job, runs):
    """Time of the processor in µs, and waits, of a run."""
    before = resource.getrusage(resource.RUSAGE_SELF)
    job()
    after = resource.getrusage(resource.RUSAGE_SELF)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return 1e6 * cpu / runs, (after.ru_nvcsw - before.ru_nvcsw) / runs


work(PART)
print("a call takes {:.1f} µs above the {:.0f} µs of the engine".format(*above()))
gains = {threads: [], processes: []}
alone, together = [], []
for _ in range(ROUNDS):
    alone.append(used(lambda: work(PART), PART))
    one = took(lambda: work(PART))
    together.append(used(threads, 2 * PART))
    for job, all in gains.items():
        all.append(2.0 * one / took(job))
for job, all in gains.items():
    print(f"two {job.__name__} do {statistics.median(all):.2f} times as many runs as one (best {max(all):.2f})")
for name, all in (("one thread", alone), ("two threads", together)):
    cpu, waits = (statistics.median(own) for own in zip(*all))
    print(f"a run of {name} takes {cpu:.0f} µs of the processor, and {waits:.3f} waits")
