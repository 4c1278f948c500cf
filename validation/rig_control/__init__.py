"""The rig under controllers in Python: against a model with the controllers inside, steps, heave, cost."""
