"""Pictures of meshes and databases: `hakobune look` and `hakobune plot`."""
