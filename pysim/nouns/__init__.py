"""The nouns a user holds: values with the verbs that belong to them."""
