"""What the thesis' published responses say of the locked model, and of the load."""
