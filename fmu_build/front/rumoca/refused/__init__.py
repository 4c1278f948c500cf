"""What rumoca would drop or mix up without a word, a file for each kind; `refusals.py` lists them."""
