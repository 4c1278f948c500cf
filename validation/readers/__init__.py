"""Readers of what others have written: an answer or one sentence, whatever the input."""
