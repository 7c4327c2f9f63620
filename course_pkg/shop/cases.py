"""Ten cases for a decision between a topic, a service and an action, each with what speaks for it."""

from __future__ import annotations

OPTIONS = ("a topic", "a service", "an action")

CASES: tuple[tuple[str, str, str], ...] = (
    (
        "A simulator mirrors the joints of an arm, which moves all the time.",
        "a topic",
        "A new stance comes every 50 ms, and only the newest counts. To ask for each would make the "
        "simulator wait and the arm work, twenty times a second.",
    ),
    (
        "A lamp is switched on, and the program goes on only when it burns.",
        "a service",
        "Whoever switches needs to know that it worked, and can be told why not. On a topic the lamp "
        "might be out of order, and nobody would hear of it.",
    ),
    (
        "A camera feeds a program that keeps the robot from running into things.",
        "a topic",
        "Each picture counts, and at once. One that is lost does little harm: the next one is there 33 ms"
        " later. And silence is a signal: no picture for half a second means stop.",
    ),
    (
        "A page in the web shows a picture of the shop, a new one every hour.",
        "a service",
        "Big, and seldom wanted. The stream would carry a hundred thousand pictures for each one that is "
        "shown.",
    ),
    (
        "A planner computes a way through the room whenever somebody has to go somewhere.",
        "a service",
        "A start and a goal go in, a way comes out, for the one who asked. It is a function. If it took a"
        " minute, it would be an action.",
    ),
    (
        "An emergency stop: a button is pressed, and everything that moves has to stand still.",
        "a topic",
        "Argue about this one. A call would say whether it worked, but it would call one motor after the "
        "other, and wait for the first that hangs. On a topic all hear it at the same time, known or not."
        " It is said again and again, and better still the other way round: all is well, ten times a "
        "second, and whoever hears nothing stops. Whether all stand still is a question to ask "
        "afterwards. (A real button also cuts the power.)",
    ),
    (
        "The level of the battery, for a display, for the log, and for a program that drives to the charger.",
        "a topic",
        "Several want it, and it need not know them. It changes slowly, so once in ten seconds is enough,"
        " latched for those who come later. If one program wanted it once a day, a service would do as "
        "well.",
    ),
    (
        "A new turtle is put into a simulator, and its name has to be one that is free.",
        "a service",
        "It is done once, it can be refused, and the answer brings something back: the name.",
    ),
    (
        "Every node tells what it does, for a log that somebody may read one day.",
        "a topic",
        "Many speak, and none of them should have to wait for the log. ROS does it like that: the topic "
        "is `/rosout`.",
    ),
    (
        "The robot drives to the kitchen, which takes two minutes, or is called back on its way.",
        "an action",
        "The caller of a service would stand still for two minutes, without a word of how far it is, and "
        "could not break it off. An action is made of topics, and has all three: a goal, news on the way,"
        " and a result.",
    ),
)
