"""Problems of the panel method and of the methods for boxes and cylinders; near-field drift by both."""
