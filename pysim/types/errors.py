"""The user's mistake, as a type."""


class BadInput(ValueError):
    """The caller asked for something that cannot be: one sentence with what, where and the cure."""
