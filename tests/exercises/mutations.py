"""Ways to bend a function by one step: an operator, a constant, a term, a condition."""

import ast
import copy

SWAPS = {
    ast.Add: [ast.Sub],
    ast.Sub: [ast.Add],
    ast.Mult: [ast.Div],
    ast.Div: [ast.Mult],
    ast.FloorDiv: [ast.Mod],
    ast.Mod: [ast.FloorDiv],
    ast.LShift: [ast.RShift],
    ast.BitAnd: [ast.BitOr],
    ast.Lt: [ast.LtE, ast.Gt],
    ast.LtE: [ast.Lt, ast.GtE],
    ast.Gt: [ast.GtE, ast.Lt],
    ast.GtE: [ast.Gt, ast.LtE],
    ast.Eq: [ast.NotEq],
    ast.And: [ast.Or],
}
NAMES = {
    "all": "any",
    "any": "all",
    "choice": "max",
    "flatnonzero": "argmax",
    "max": "min",
    "maximum": "minimum",
    "mean": "median",
    "sum": "prod",
    "zeros": "ones",
}


def mutants(source):
    """
    Yield the name and the source of each mutant of a function.

    >>> for name, _ in mutants("def f(x): return x + 1"):
    ...     print(name)
    return x + 1: x + 1 -> x - 1
    return x + 1: x + 1 -> x
    return x + 1: x + 1 -> 1
    return x + 1: 1 -> 2
    return x + 1: 1 -> 0
    """
    tree = ast.parse(source)
    body = tree.body[0].body
    if ast.get_docstring(tree.body[0]):  # it is no code
        del body[0]
    lines = {}  # of each node, the first line of the statement that it is in
    for statement in (node for node in ast.walk(tree) if isinstance(node, ast.stmt)):
        line = ast.unparse(statement).split("\n")[0]
        lines.update(dict.fromkeys(ast.walk(statement), line))  # the innermost is last
    for place, node in enumerate(ast.walk(tree)):
        for other in _others(node):
            bent = copy.deepcopy(tree)
            target = list(ast.walk(bent))[place]
            bent = ast.fix_missing_locations(_Put(target, other).visit(bent))
            change = f"{ast.unparse(node)} -> {ast.unparse(other)}"
            yield f"{lines.get(node)}: {change}", ast.unparse(bent)


class _Put(ast.NodeTransformer):
    def __init__(self, target, other):
        self.target, self.other = target, other

    def visit(self, node):
        return self.other if node is self.target else self.generic_visit(node)


def _others(node):
    """Yield what may stand in for a node."""
    match node:
        case ast.BinOp():
            for op in SWAPS.get(type(node.op), ()):
                yield ast.BinOp(node.left, op(), node.right)
            yield from (node.left, node.right)
        case ast.BoolOp():
            for op in SWAPS.get(type(node.op), ()):
                yield ast.BoolOp(op(), node.values)
            yield from node.values
        case ast.Compare():
            for op in SWAPS.get(type(node.ops[0]), ()):
                yield ast.Compare(node.left, [op()], node.comparators)
        case ast.UnaryOp():
            yield node.operand
        case ast.Constant(value=bool()):
            yield ast.Constant(not node.value)
        case ast.Constant(value=int() | float()):
            yield from (ast.Constant(node.value + 1), ast.Constant(node.value - 1))
        case ast.Name(id=name) if name in NAMES:
            yield ast.Name(NAMES[name], node.ctx)
        case ast.Attribute(attr=name) if name in NAMES:
            yield ast.Attribute(node.value, NAMES[name], node.ctx)
        case ast.IfExp():
            yield from (node.body, node.orelse)
        case ast.If():
            for always in (True, False):
                yield ast.If(ast.Constant(always), node.body, node.orelse)
        case ast.AugAssign():
            yield ast.Assign([node.target], node.value, lineno=0)
            yield ast.Pass()
        case ast.Expr():
            yield ast.Pass()
