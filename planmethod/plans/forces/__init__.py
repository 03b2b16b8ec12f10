"""Force plans of the dyads and of the driver, the Zhukovsky lever (планы сил)."""
