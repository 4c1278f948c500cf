"""Ties that a diagnosis gave, each put to the test that it proposes."""
