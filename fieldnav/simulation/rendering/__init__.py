"""Pictures of the simulated field: light, ground, foliage and colours, composed by the renderer."""
