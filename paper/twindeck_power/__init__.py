"""How much the check against the paper notices: inputs are changed one at a time, what depends on them is run anew, and the check looks."""
