"""
Measure nanoseconds per step: ours, beside what people would use instead.

The task is the paper's (target map, 18,900 states, 8 actions, reward "goal").  A
machine is never quiet, so all contestants take turns in many short rounds, and what
counts is the ratio to the C loop in the same round, of all rounds the middle one.
CPU time; one core.

    python benchmarks/run.py [--rounds 30] [--out data/results/bench.json]

To see what a processor with narrower vectors would run, on this one:

    NUMBA_CPU_NAME=haswell NUMBA_CPU_FEATURES=+avx2,+fma,+bmi,+bmi2,+popcnt \
        NUMBA_CACHE_DIR=/tmp/narrow python benchmarks/run.py --out /tmp/narrow.json
"""

from __future__ import annotations

import argparse
import json
import platform
from importlib import metadata
from pathlib import Path

import numpy as np
import processor
from contestants import STEPS, contestants, seconds

ROOT = Path(__file__).parents[1]
STRATEGIES = ("none", "hard", "soft")


def measure(strategy: str, rounds: int, quiet: list[float]) -> list[dict]:
    """Return one row per contestant: nanoseconds per step, and ratios to C."""
    racing = contestants(strategy, rounds * STEPS)
    ns = {name: [] for name in racing}
    for i in range(rounds):
        quiet.append(processor.quietness())
        for name, (contestant, n_steps) in list(racing.items())[:: 1 - i % 2 * 2]:
            spent = seconds(contestant, i * n_steps + 1, (i + 1) * n_steps)
            ns[name].append(spent / n_steps / contestant.n_runs * 1e9)
    yard = ns.get("C, straightforward")
    return [
        {
            "strategy": strategy,
            "name": name,
            "ns_per_step": round(float(np.median(values)), 2),
            "by_round": [round(value, 2) for value in values],
            "times_c": yard and round(float(np.median(np.divide(yard, values))), 4),
        }
        for name, values in ns.items()
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[1])
    parser.add_argument("--rounds", type=int, default=30)
    parser.add_argument("--out", type=Path, default=ROOT / "data/results/bench.json")
    options = parser.parse_args()
    rows, quiet = [], []
    print(f"{processor.name()}; vectors: {processor.vectors()}")
    for strategy in STRATEGIES:
        for row in measure(strategy, options.rounds, quiet):
            rows.append(row)
            times = f"{row['times_c']:8.3f} x C" if row["times_c"] else ""
            print(
                f"{strategy:5} {row['name']:30} {row['ns_per_step']:10.1f} ns {times}"
            )
    quiet = [round(value, 2) for value in np.quantile(quiet, [0, 0.5, 1])]
    print("independent operations a cycle (quiet: above 3): lowest, middle, highest")
    print(*quiet)
    record = {
        "task": "target map, reward goal, 18,900 states, 8 actions; one core",
        "steps": options.rounds * STEPS,
        "machine": platform.machine(),
        "processor": processor.name(),
        "vectors": processor.vectors(),
        "operations_a_cycle": quiet,
        "python": platform.python_version(),
        "versions": {name: metadata.version(name) for name in ("numpy", "numba")},
        "rows": rows,
    }
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
