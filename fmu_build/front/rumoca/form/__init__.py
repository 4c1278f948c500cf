"""The only place that knows rumoca's tree: `to_flat_model` turns its DAE and flat form into a `FlatModel`."""

from fmu_build.front.rumoca.form.model import to_flat_model

__all__ = ["to_flat_model"]
