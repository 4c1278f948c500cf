"""Matching of equations with unknowns, and the order of the blocks they form."""

from collections import deque
from collections.abc import Sequence


class Matching:
    """A bipartite matching that grows one equation at a time along augmenting paths.

    `equation_of[v]` is the equation that unknown v is matched with, -1 for none.
    """

    def __init__(self, n_unknowns: int) -> None:
        self.equation_of = [-1] * n_unknowns
        self._unknown_of: dict[int, int] = {}

    def grow(self) -> None:
        """One more unknown, the last."""
        self.equation_of.append(-1)

    def match(self, unknown: int, equation: int) -> None:
        """Give an unknown to an equation, one that has none yet or gives up its own."""
        self.equation_of[unknown], self._unknown_of[equation] = equation, unknown

    def add(self, equation: int, unknowns_of: Sequence[Sequence[int]]) -> set[int]:
        """Match `equation`, breadth first.

        Returns:
            empty when matched; otherwise every equation met, which together have too few unknowns.
        """
        came_from: dict[int, int] = {}  # unknown -> equation it was reached from
        met = {equation}
        queue = deque([equation])
        while queue:
            current = queue.popleft()
            for unknown in unknowns_of[current]:
                if unknown in came_from:
                    continue
                came_from[unknown] = current
                owner = self.equation_of[unknown]
                if owner < 0:
                    self._augment(unknown, came_from)
                    return set()
                met.add(owner)
                queue.append(owner)
        return met

    def _augment(self, unknown: int, came_from: dict[int, int]) -> None:
        while True:
            equation = came_from[unknown]
            given_up = self._unknown_of.get(equation)
            self.match(unknown, equation)
            if given_up is None:
                return
            unknown = given_up


def blocks(successors: Sequence[Sequence[int]]) -> list[list[int]]:
    """Strongly connected components, each after those it points at (Tarjan 1972), without recursion."""
    n = len(successors)
    index, low = [-1] * n, [0] * n
    on_stack = [False] * n
    stack: list[int] = []
    result: list[list[int]] = []
    counter = 0
    for root in range(n):
        if index[root] >= 0:
            continue
        work = [(root, 0)]
        while work:
            node, position = work.pop()
            if position == 0:
                index[node] = low[node] = counter
                counter += 1
                stack.append(node)
                on_stack[node] = True
            descend = False
            for k in range(position, len(successors[node])):
                other = successors[node][k]
                if index[other] < 0:
                    work += [(node, k + 1), (other, 0)]
                    descend = True
                    break
                if on_stack[other]:
                    low[node] = min(low[node], index[other])
            if descend:
                continue
            if low[node] == index[node]:
                component = []
                while on_stack[node]:
                    component.append(stack.pop())
                    on_stack[component[-1]] = False
                result.append(sorted(component))
            if work:
                low[work[-1][0]] = min(low[work[-1][0]], low[node])
    return result
