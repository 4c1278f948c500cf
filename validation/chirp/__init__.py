"""One chirp against stepped sines on a model whose two directions differ."""
