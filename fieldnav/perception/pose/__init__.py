"""What the crop and the pictures tell of the cameras themselves."""
