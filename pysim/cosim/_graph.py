"""What depends on what at one instant: the order of evaluation, and the circles in it."""

from __future__ import annotations

from collections.abc import Mapping
from graphlib import TopologicalSorter

import numpy as np

Graph = Mapping[str, frozenset[str]]


def components(graph: Graph) -> list[tuple[str, ...]]:
    """Nodes that depend on each other in a circle, together; all in an order in which each comes after what it needs.

    Args:
        graph: node -> nodes it depends on; all of them are keys.
    """
    from scipy.sparse import coo_array  # 0.2 s to import, which no process of a single member has to wait for
    from scipy.sparse.csgraph import connected_components

    nodes = list(graph)
    number = {node: i for i, node in enumerate(nodes)}
    pairs = [(number[node], number[need]) for node in nodes for need in graph[node]]
    rows, columns = (np.array([pair[i] for pair in pairs], dtype=np.intp) for i in (0, 1))
    matrix = coo_array((np.ones(len(pairs)), (rows, columns)), shape=(len(nodes), len(nodes)))
    labels = connected_components(matrix, connection="strong")[1] if nodes else []
    groups: dict[int, list[str]] = {}
    for node, label in zip(nodes, labels, strict=True):
        groups.setdefault(int(label), []).append(node)
    sorter = TopologicalSorter(
        {label: {int(labels[number[n]]) for m in group for n in graph[m]} - {label} for label, group in groups.items()}
    )
    return [tuple(groups[label]) for label in sorter.static_order()]


def is_circle(group: tuple[str, ...], graph: Graph) -> bool:
    """Whether a component needs itself."""
    return len(group) > 1 or group[0] in graph[group[0]]


def one_circle(group: tuple[str, ...], graph: Graph) -> tuple[str, ...]:
    """A shortest way from the first node of a circle back to it, along what drives what."""
    first = group[0]
    ways: dict[str, tuple[str, ...]] = {first: (first,)}
    reached = [first]
    while reached:
        node = reached.pop(0)
        for after in group:
            if node in graph[after]:
                if after == first:
                    return (*ways[node], first)
                if after not in ways:
                    ways[after] = (*ways[node], after)
                    reached.append(after)
    return group
