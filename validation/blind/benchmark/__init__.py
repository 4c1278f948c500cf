"""The blind benchmark: cases of the plant's table diagnosed and judged, by one commit."""
