"""Many runs of many arms, on as many workers as there are, and what they say."""
