"""Problems of the panel method and of the methods for boxes and cylinders, and near-field drift by these methods."""
