"""
Measure nanoseconds per step: ours, beside what people would use instead.

The task is the paper's (target map, 18,900 states, 8 actions, reward "goal").  A
machine is never quiet, so all contestants take turns within each round, and what
counts is the ratio to the C loop of the same round.  CPU time; one core.

    python benchmarks/run.py [--rounds 6] [--out data/results/bench.json]
"""

from __future__ import annotations

import argparse
import json
import platform
from importlib import metadata
from pathlib import Path

import numpy as np
from contestants import STEPS, contestants, seconds

ROOT = Path(__file__).parents[1]
STRATEGIES = ("none", "hard", "soft")


def measure(strategy: str, rounds: int) -> list[dict]:
    """Return one row per contestant: nanoseconds per step, and ratios to C."""
    ns = {}
    racing = contestants(strategy, rounds * STEPS)
    for i in range(rounds):
        for name, (contestant, n_steps) in racing.items():
            spent = seconds(contestant, i * n_steps + 1, (i + 1) * n_steps)
            ns.setdefault(name, []).append(spent / n_steps / contestant.n_runs * 1e9)
    yard = ns.get("C, straightforward")
    return [
        {
            "strategy": strategy,
            "name": name,
            "ns_per_step": round(float(np.mean(values)), 2),
            "by_round": [round(value, 2) for value in values],
            "times_c": yard and round(float(np.mean(yard) / np.mean(values)), 4),
        }
        for name, values in ns.items()
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[1])
    parser.add_argument("--rounds", type=int, default=6)
    parser.add_argument("--out", type=Path, default=ROOT / "data/results/bench.json")
    options = parser.parse_args()
    rows = []
    for strategy in STRATEGIES:
        for row in measure(strategy, options.rounds):
            rows.append(row)
            times = f"{row['times_c']:8.3f} x C" if row["times_c"] else ""
            print(
                f"{strategy:5} {row['name']:28} {row['ns_per_step']:10.1f} ns {times}"
            )
    record = {
        "task": "target map, reward goal, 18,900 states, 8 actions; one core",
        "steps": options.rounds * STEPS,
        "machine": platform.machine(),
        "processor": _processor(),
        "python": platform.python_version(),
        "versions": {name: metadata.version(name) for name in ("numpy", "numba")},
        "rows": rows,
    }
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def _processor() -> str:
    """Return what the system calls the processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    return next((x.split(": ")[1] for x in lines if x.startswith("model name")), "")


if __name__ == "__main__":
    main()
