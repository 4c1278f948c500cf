"""What the pistons' pull on the swash plate should change in Tables 4.1 and 4.3."""
