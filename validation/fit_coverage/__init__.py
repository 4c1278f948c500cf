"""Whether the intervals of a fit hold the truth as often as they say."""
