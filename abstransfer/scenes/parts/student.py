"""Student's quantiles, for scripts: they know no law of chance."""

from __future__ import annotations

from ...experiments.stats import FEWEST, quantile

MOST = 50  # runs
#: How many standard errors an interval of the mean of n runs reaches, at place n.
STUDENT = [quantile(n) if n >= FEWEST else None for n in range(MOST + 1)]
