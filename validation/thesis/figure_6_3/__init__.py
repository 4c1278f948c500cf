"""Table 6.2 and Figure 6.3: friction of both motors."""
