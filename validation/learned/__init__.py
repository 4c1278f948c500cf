"""Laws that no catalogue holds, in a plant of our own: is the law learned, at its place, and does the error fall?"""
