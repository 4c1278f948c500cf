"""Complete models under noise and starts of every kind: how often a diagnosis names something that is not missing."""
