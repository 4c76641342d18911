"""What the machine is, and how quiet: without it no time means anything."""

from __future__ import annotations

import platform
import time
from itertools import pairwise
from pathlib import Path

from llvmlite.binding import get_host_cpu_features
from numba import config, njit

CHAIN = 300_000  # links: a fifth of a millisecond, shorter than a turn on the core


def name() -> str:
    """Return what the system calls the processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    return next((x.split(": ")[1] for x in lines if x.startswith("model name")), "")


def vectors() -> str:
    """Return the widest vectors that our loops are compiled for."""
    used = config.CPU_FEATURES
    features = get_host_cpu_features().flatten() if used is None else used
    found = "AVX-512" if "+avx512f" in features else "128 bits"
    found = "AVX2" if "+avx2" in features and found == "128 bits" else found
    return found + (f", restricted to {config.CPU_NAME}" if config.CPU_NAME else "")


@njit
def _one(n, a):
    for i in range(n):
        a = (a ^ i) + i
    return a


@njit
def _four(n, a, b, c, d):
    for i in range(n):
        a, b, c, d = (a ^ i) + i, (b ^ i) + i, (c ^ i) + i, (d ^ i) + i
    return a ^ b ^ c ^ d


def quietness() -> float:
    """
    Return how many independent operations are done in a cycle, 4 at most.

    In a chain each waits for the one before, a cycle; four chains could take no
    longer than one.  Above 3 it is quiet; about 2, something shares the core.
    """
    one, four = _seconds(_one, 1), _seconds(_four, 1, 2, 3, 4)
    return 4 * one / four


def _seconds(chains, *starts) -> float:
    """Return what chains take, of three times the least: one may be interrupted."""
    chains(1, *starts)  # compiles
    times = [time.process_time()]
    for _ in range(3):
        chains(CHAIN, *starts)
        times.append(time.process_time())
    return min(after - before for before, after in pairwise(times))
