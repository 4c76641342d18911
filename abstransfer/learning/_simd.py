"""
Eight values at once: the one place where the fast loop leaves plain Python.

A row of eight doubles is one register, or a few.  Left to itself the compiler
loads and compares the eight one by one, which costs the fast loop a third of its
speed, so the instructions are spelt out in its own language, for any processor.
"""

from __future__ import annotations

from llvmlite import ir
from numba import types
from numba.extending import intrinsic, overload

WIDTH = 8  # entries of a row
MIDDLE = 1 << 31  # less this, a word is an int32, in the same order


def put(q, start, a, x):
    """
    Set ``q[start + a] = x``; return the largest of the row and where it stands.

    The row is ``q[start : start + 8]``.  Bit i of the second number is set if
    entry i equals the largest.

    >>> put([0.0] * 8, 0, 2, 1.5)
    (1.5, 4)
    """
    q[start + a] = x
    row = [float(value) for value in q[start : start + WIDTH]]
    top = max(row)
    return top, sum(1 << i for i, value in enumerate(row) if value == top)


@overload(put)
def _put(q, start, a, x):
    return lambda q, start, a, x: _put_at_once(q, start, a, x)


@intrinsic
def _put_at_once(typing_context, q, start, a, x):
    signature = types.Tuple((types.float64, types.int64))(q, start, a, x)

    def generate(context, builder, signature, arguments):
        q, start, a, x = arguments
        a = context.cast(builder, a, signature.args[2], types.int64)
        data = context.make_array(signature.args[0])(context, builder, q).data
        place = builder.gep(data, [start])
        row = builder.load(builder.bitcast(place, _ROW.as_pointer()))
        row.align = 8
        here = builder.icmp_signed("==", _spread(builder, a), _PLACES)
        others = builder.select(here, _NOTHING, row)
        builder.store(x, builder.gep(place, [a]))
        top = others
        for half in (4, 2, 1):
            low = _shuffle(builder, top, range(half))
            high = _shuffle(builder, top, range(half, 2 * half))
            top = _larger(builder, low, high)
        top = builder.extract_element(top, ir.IntType(32)(0))
        ties = builder.fcmp_ordered("==", others, _spread(builder, top))
        # Up to here x is not asked for: it often comes later than the row.
        ties = builder.zext(builder.bitcast(ties, ir.IntType(8)), a.type)
        stay = builder.sext(builder.fcmp_ordered(">=", top, x), a.type)
        join = builder.zext(builder.fcmp_ordered(">=", x, top), a.type)
        ties = builder.or_(builder.and_(ties, stay), builder.shl(join, a))
        top = _larger(builder, x, top)
        return context.make_tuple(builder, signature.return_type, [top, ties])

    return signature, generate


_ROW = ir.VectorType(ir.DoubleType(), WIDTH)
_PLACES = ir.Constant(ir.VectorType(ir.IntType(64), WIDTH), list(range(WIDTH)))
_NOTHING = ir.Constant(_ROW, [float("-inf")] * WIDTH)


def _larger(builder, x, y):
    """Return the larger of two numbers, or of each two of two vectors."""
    return builder.select(builder.fcmp_ordered(">", x, y), x, y)


def _shuffle(builder, vector, order):
    """Return these entries of a vector, in this order."""
    order = ir.Constant(ir.VectorType(ir.IntType(32), len(order)), list(order))
    return builder.shuffle_vector(vector, ir.Constant(vector.type, ir.Undefined), order)


def _spread(builder, number):
    """Return a vector of eight times this number."""
    vector = ir.Constant(ir.VectorType(number.type, WIDTH), ir.Undefined)
    vector = builder.insert_element(vector, number, ir.IntType(32)(0))
    return _shuffle(builder, vector, [0] * WIDTH)


def count_below(last, start, number):
    """
    Return how many of ``last[start : start + 8]`` (int32) are below a number.

    >>> count_below([9, 19, 29, 29, 99, 99, 99, 99], 0, 30)
    4
    """
    return sum(int(limit < number) for limit in last[start : start + WIDTH])


@overload(count_below)
def _count_below(last, start, number):
    return lambda last, start, number: _count_at_once(last, start, number)


@intrinsic
def _count_at_once(typing_context, last, start, number):
    signature = types.int64(last, start, number)

    def generate(context, builder, signature, arguments):
        last, start, number = arguments
        number = context.cast(builder, number, signature.args[2], types.int32)
        data = context.make_array(signature.args[0])(context, builder, last).data
        place = builder.gep(data, [start])
        row = ir.VectorType(ir.IntType(32), WIDTH)
        row = builder.load(builder.bitcast(place, row.as_pointer()))
        row.align = 4
        below = builder.icmp_signed("<", row, _spread(builder, number))
        below = builder.zext(builder.bitcast(below, ir.IntType(8)), ir.IntType(64))
        return builder.ctpop(below)

    return signature, generate
