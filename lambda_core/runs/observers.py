"""Call observers and events with the samples of a run."""

from __future__ import annotations

import contextlib
import logging
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import DIMENSIONS, Channel
from lambda_core.domain.plugin_errors import PluginError, blamed
from lambda_core.model.bearing_model import BearingModel, ChosenEvent, ChosenObserver
from lambda_core.results.event_rows import EVENTS
from lambda_core.results.provenance import model_data

if TYPE_CHECKING:
    from lambda_core.results.reader import Result
    from lambda_core.results.run_status import Rows

Answer = TypeVar("Answer")

log = logging.getLogger("lambda_core")
_FROM_THE_START = '; it holds from the start: change its parameters, or write events.{}.action = "record"'


@dataclass(frozen=True)
class Seen:
    """Results of observers and events.

    They belong to a stretch of samples.
    """

    channels: dict[str, FloatArray]  # of the observers, by name
    events: dict[str, FloatArray]  # columns of EVENTS


class Watch:
    """The observers and events of one run.

    What they make of a sample follows from that sample alone, integrals aside, which go on from the last: a run that
    goes on from a checkpoint writes what it would have written without a stop.

    Parameters
    ----------
    model : BearingModel
        Whose observers and events are called.
    is_trial : bool
        Keep faults without a line in the log: the caller reports them.
    """

    def __init__(self, model: BearingModel, *, is_trial: bool = False) -> None:
        self._is_trial = is_trial
        self._model = model
        self._observers, self._events = model.observers, model.events
        self._data = model_data(model) if self.any else {}
        self._sizes = {name: len(labels) for name, labels in DIMENSIONS.items()}
        self._sizes |= {"ball": model.geometry.balls, "marker": len(model.markers)}
        self._before: dict[str, FloatArray] = {}  # time, rates and integrals at the sample before
        self._was: dict[str, bool] = {}  # event -> whether it was so at the sample before
        self.failed: dict[str, str] = {}  # "observer/NAME" or "event/NAME" -> sentence
        self.without_numbers: dict[str, str] = {}  # channel of an observer without a finite number -> sentence
        self.ended_by = ""  # a sentence, once an event that stops the run has happened

    @property
    def any(self) -> bool:
        """True if there is an observer or event."""
        return bool(self._observers or self._events)

    @property
    def prompt(self) -> bool:
        """True if samples are needed at once.

        An event may end the run.
        """
        return any(chosen.action == "stop" for chosen in self._events.values())

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Return what the observers write."""
        return tuple(channel for chosen in self._observers.values() for channel in chosen.item.written())

    @property
    def faults(self) -> tuple[str, ...]:
        """Reasons for stopped observers and events.

        Each reason is one sentence.
        """
        return tuple(self.failed.values())

    def keys(self) -> dict[str, str]:
        """Return the hashes of observers and events.

        The keys are "observer/NAME" or "event/NAME"; the hash is that of the function's module.
        """
        found = {f"observer/{name}": chosen.item.key for name, chosen in self._observers.items()}
        return found | {f"event/{name}": chosen.item.key for name, chosen in self._events.items()}

    def take(self, samples: Mapping[str, NDArray[np.float64]]) -> Seen:
        """Call every observer and event.

        They get a stretch of samples, a mapping of channel to array; events see observers' channels.
        """
        shown = {name: _locked(values) for name, values in samples.items()}
        channels: dict[str, FloatArray] = {}
        for name, chosen in self._observers.items():
            channels |= self._observed(name, chosen, shown)
        self._before |= {name: values[-1] for name, values in {"time": samples["time"], **channels}.items()}
        shown |= {name: _locked(values) for name, values in channels.items()}
        starts = [self._happened(name, chosen, number, shown) for number, (name, chosen) in enumerate(self._chosen())]
        rows = np.array(sorted(row for found in starts for row in found)).reshape(-1, len(EVENTS))
        return Seen(channels, {channel.name: rows[:, i] for i, channel in enumerate(EVENTS)})

    def catch_up(self, result: Result, rows: Rows) -> None:
        """Restore the state behind the last valid sample."""
        if not self.any or not rows.samples:
            return
        last = {channel.name: result[channel.name][rows.samples - 1 : rows.samples] for channel in result.channels}
        written = {channel.name for channel in self.channels}
        self._before = {name: last[name][0] for name in ("time", *written)}
        shown = {name: _locked(values) for name, values in last.items()}
        for name, chosen in self._chosen():
            found = self._called(f"event/{name}", chosen, shown)
            self._was[name] = bool(found is not None and found[-1])

    def _chosen(self) -> list[tuple[str, ChosenEvent]]:
        return list(self._events.items())

    def _observed(self, name: str, chosen: ChosenObserver, samples: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
        """Return the channels of one observer.

        NaN from the call on in which it failed.
        """
        item, count = chosen.item, len(samples["time"])
        shapes = {c.name: (count, *(self._sizes[dim] for dim in c.dims)) for c in item.channels}

        def observe() -> dict[str, FloatArray]:
            found = item.observe(samples, chosen.parameters, self._data)
            if not isinstance(found, Mapping) or set(found) != set(shapes):
                raise PluginError(f"{what} returns other channels than it declares: {', '.join(shapes)}")
            for key in shapes:
                if np.iscomplexobj(found[key]):
                    raise PluginError(f"{what} returns {key} as complex numbers, not real ones")
            arrays = {key: np.array(found[key], dtype=np.float64) for key in shapes}
            for key, values in arrays.items():
                if values.shape != shapes[key]:
                    raise PluginError(f"{what} returns {key} of shape {values.shape}, not {shapes[key]}")
            return arrays

        what = f'the observer "{name}" ({item.distribution})'
        arrays = self._guarded(f"observer/{name}", what, observe)
        if arrays is None:
            arrays = {key: np.full(shape, np.nan) for key, shape in shapes.items()}
        else:
            self._report_without_numbers(what, arrays, float(samples["time"][0]))
        for integral in item.integrals:
            arrays[integral.name] = self._integrated(integral.name, integral.of, arrays[integral.of], samples["time"])
        return arrays

    def _report_without_numbers(self, what: str, arrays: Mapping[str, FloatArray], time: float) -> None:
        """Report each channel without finite numbers once.

        It looks at one stretch of samples.
        """
        for key, values in arrays.items():
            if key not in self.without_numbers and not np.isfinite(values).any():
                self.without_numbers[key] = f"{what} returns no finite number as {key} from t = {time:.6g} s"
                if not self._is_trial:
                    log.warning("%s", self.without_numbers[key])

    def _integrated(self, name: str, of: str, rate: FloatArray, time: FloatArray) -> FloatArray:
        """Go on with a time integral.

        Values are summed one after the other, so the ends of stretches do not matter.
        """
        first = not self._before
        start = np.zeros(rate.shape[1:]) if first else self._before[name]
        times = np.concatenate([[time[0] if first else self._before["time"]], time])
        rates = np.concatenate([rate[:1] if first else self._before[of][None], rate])
        steps = np.diff(times).reshape(-1, *([1] * (rate.ndim - 1)))
        return np.cumsum(np.concatenate([start[None], 0.5 * steps * (rates[1:] + rates[:-1])]), axis=0)[1:]

    def _happened(
        self, name: str, chosen: ChosenEvent, number: int, samples: Mapping[str, FloatArray]
    ) -> list[tuple[float, float]]:
        """Return (time, number) of every event's beginning.

        Note one that ends the run.
        """
        found = self._called(f"event/{name}", chosen, samples)
        if found is None:
            return []
        begins = found & ~np.concatenate([[self._was.get(name, False)], found[:-1]])
        self._was[name] = bool(found[-1])
        times = samples["time"][begins]
        if times.size and chosen.action == "stop" and not self.ended_by:
            held = "" if times[0] > 0.0 else _FROM_THE_START.format(name)
            self.ended_by = f"ended by the event {name} at t = {times[0]:.6g} s: {chosen.item.title}{held}"
        return [(float(time), float(number)) for time in times]

    def _called(self, key: str, chosen: ChosenEvent, samples: Mapping[str, FloatArray]) -> NDArray[np.bool_] | None:
        """Ask an event; None once it has failed."""
        count, what = len(samples["time"]), f'the event "{chosen.item.name}" ({chosen.item.distribution})'

        def happens() -> NDArray[np.bool_]:
            found = np.asarray(chosen.item.happens(samples, chosen.parameters, self._data))
            if found.shape != (count,) or found.dtype != np.bool_:
                raise PluginError(f"{what} returns {found.dtype} of shape {found.shape}, not bool of shape ({count},)")
            return found

        return self._guarded(key, what, happens)

    def _guarded(self, key: str, what: str, call: Callable[[], Answer]) -> Answer | None:
        """Call a plugin's function.

        Report its first error, and do not call it again.
        """
        if key in self.failed:
            return None
        try:
            # stdout is for data, and numpy's warnings about a plugin's arithmetic are no news of ours
            with contextlib.redirect_stdout(sys.stderr), np.errstate(all="ignore"), blamed(what):
                return call()
        except PluginError as error:
            self.failed[key] = str(error)
            if not self._is_trial:
                log.warning("%s; it is not called any more", error)
            return None


def _locked(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a view that cannot be written to."""
    view = values.view()
    view.flags.writeable = False
    return view
