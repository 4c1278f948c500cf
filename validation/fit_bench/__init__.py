"""The grey-box fit on measurements of an independently written plant."""
