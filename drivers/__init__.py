"""The wheel modules and the cameras: ports, hardware, and the simulated modules beside them."""
