"""Where the heat of an answer goes, and how hot all is, from its results by name."""

HEATED = "heat_to_shaft"  # a result that only an answer with heat has
SAME = 1.0e-6  # of the power: a smaller flow is none
FLOWS = {"heat_to_shaft": "into the shaft", "heat_through_bumps": "through the bumps", "heat_to_channel": "to the cooling gas",
         "heat_by_gas": "with the film's gas"}
TEMPERATURES = {  # mean, and largest where there is one
    "film": ("film_temperature", "maximum_film_temperature"), "top foil": ("top_foil_temperature", "maximum_top_foil_temperature"),
    "shaft": ("shaft_temperature", None), "sleeve": ("sleeve_temperature", None), "drawn in at the slit": ("inlet_temperature", None),
    "cooling gas, out": ("cooling_outlet_temperature", None)}


def balance(results):
    """(words, W) of the power loss and of each way that heat takes; a way that carries nothing is left out."""
    power = float(results["power_loss"])
    ways = [(words, float(results[name])) for name, words in FLOWS.items() if name in results]
    # A top foil that is held at a temperature takes what neither bumps nor channel carry on.
    held = float(results["heat_to_top_foil"]) - sum(float(results.get(name, 0.0)) for name in ("heat_through_bumps", "heat_to_channel"))
    ways.append(("into the top foil, held", held))
    return [("power loss", power), *((words, flow) for words, flow in ways if abs(flow) > SAME*max(abs(power), abs(ways[0][1])))]


def temperatures(results):
    """(words, mean, largest) of what has a temperature [K]; largest is None where there is one alone."""
    return [(words, float(results[mean]), None if largest is None else float(results[largest]))
            for words, (mean, largest) in TEMPERATURES.items() if mean in results and results[mean] == results[mean]]
