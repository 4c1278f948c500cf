"""The thesis' own fits, Section 4.4, done again."""
