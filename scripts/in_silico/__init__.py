"""The paper's experiments, computed: what `scripts/experiments` runs."""
