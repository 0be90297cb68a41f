"""The models that nsode ships."""
