/* The yardstick: Q-learning as one would write it in C, one run at a time.
 *
 * Doubles, one draw per decision, two scans of a row per step.  The tables are
 * those of an MDP with A actions and K outcomes: next (S, A, K), cum (S, A, K) and
 * the guide's cum (R, A) hold cumulative probabilities.
 */
#include <stdint.h>

enum { A = 8, K = 5 };

typedef struct {
    const int32_t *next, *row, *start;
    const double *cum, *reward, *guide;
    const uint8_t *terminal;
    int64_t n_start, tau, max_episode, hard;
    double alpha, epsilon, gamma;
    /* what changes */
    double *q;
    uint64_t word[4];
    int64_t s, length, goals;
} Run;

static uint64_t rotate(uint64_t x, int k) { return x << k | x >> (64 - k); }

/* xoshiro256++: a double in [0, 1) */
static double draw(uint64_t *w)
{
    uint64_t word = rotate(w[0] + w[3], 23) + w[0], shifted = w[1] << 17;
    w[2] ^= w[0];
    w[3] ^= w[1];
    w[1] ^= w[2];
    w[0] ^= w[3];
    w[2] ^= shifted;
    w[3] = rotate(w[3], 45);
    return (word >> 11) * 0x1.0p-53;
}

static int pick(const double *cum, int n, double u)
{
    int i = 0;
    while (i < n - 1 && u >= cum[i])
        i++;
    return i;
}

static double largest(const double *row)
{
    double top = row[0];
    for (int a = 1; a < A; a++)
        if (row[a] > top)
            top = row[a];
    return top;
}

static int greedy(const double *row, uint64_t *word)
{
    double top = largest(row);
    int ties = 0;
    for (int a = 0; a < A; a++)
        ties += row[a] == top;
    int skip = ties > 1 ? (int)(draw(word) * ties) : 0;
    for (int a = 0; a < A; a++)
        if (row[a] == top && skip-- == 0)
            return a;
    return 0;
}

void learn(Run *run, int64_t first, int64_t last)
{
    Run r = *run;
    for (int64_t t = first; t <= last; t++) {
        int a;
        if (t <= r.tau && (r.hard || draw(r.word) < (double)(r.tau - t) / r.tau))
            a = pick(r.guide + A * r.row[r.s], A, draw(r.word));
        else if (draw(r.word) < r.epsilon)
            a = (int)(draw(r.word) * A);
        else
            a = greedy(r.q + A * r.s, r.word);
        int64_t i = A * r.s + a;
        int64_t to = r.next[K * i + pick(r.cum + K * i, K, draw(r.word))];
        double target = r.reward[to] + r.gamma * largest(r.q + A * to);
        r.q[i] = (1 - r.alpha) * r.q[i] + r.alpha * target;
        r.s = to;
        r.length++;
        r.goals += r.terminal[to];
        if (r.terminal[to] || r.length == r.max_episode) {
            r.s = r.start[(int64_t)(draw(r.word) * r.n_start)];
            r.length = 0;
        }
    }
    *run = r;
}
