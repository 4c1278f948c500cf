"""Black-box transfer functions: printed ones come back, and their intervals hold what they say."""
