"""Logs of five real machines, with a base model and a small catalogue for each."""
