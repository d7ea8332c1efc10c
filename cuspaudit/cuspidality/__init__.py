"""The theorem applied: the decision of Algorithm 1 on a variety and a map."""
