"""Problems of the panel method and of those for boxes and cylinders, and near-field drift of either."""
