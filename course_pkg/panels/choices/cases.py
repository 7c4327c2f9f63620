"""The default cases of choose(): situations for a topic, a service or an action, each with its reason."""

from __future__ import annotations

QUESTION = "How would you do it?"

OPTIONS = ("a topic", "a service", "an action")

CASES: tuple[tuple[str, str, str], ...] = (
    (
        "A simulator mirrors the joints of an arm, which moves all the time.",
        "a topic",
        "New joint states come every 50 ms, and only the newest ones count. With a service, the simulator "
        "would make twenty calls per second and wait for each response.",
    ),
    (
        "A lamp is switched on, and the program continues only when the lamp is on.",
        "a service",
        "The program needs to know that the lamp is on, or why it is not. A message on a topic gets no "
        "answer.",
    ),
    (
        "A camera sends pictures to a program that keeps the robot from hitting obstacles.",
        "a topic",
        "The program needs each picture at once. After a lost picture the next one comes 33 ms later. "
        "Silence is a signal, too: if no picture comes for half a second, the robot stops.",
    ),
    (
        "A web page shows a picture of the shop, a new one every hour.",
        "a service",
        "A picture is large and is needed seldom. A stream would carry a hundred thousand pictures for "
        "each one that the page shows.",
    ),
    (
        "A planner computes a path through the room when the robot has to go somewhere.",
        "a service",
        "The request has a start and a goal, and the response has the path for this one client. If the "
        "planner needed a minute, an action would be better.",
    ),
    (
        "An emergency stop: a person presses a button, and every motor has to stop.",
        "a topic",
        "You can argue about this case. A client of a service would call one motor after the other, and "
        "wait for the first one that does not respond. On a topic all motors get the message at the same "
        "time. A safe design publishes *all is well* ten times per second, and a motor that receives "
        "nothing stops. A real button also cuts the power.",
    ),
    (
        "The battery level, for a display, for the log, and for a program that drives to the charger.",
        "a topic",
        "Several nodes need the level, and the publisher does not have to know them. The level changes "
        "slowly, so one message in ten seconds is enough, latched for nodes that start later. For a "
        "single client that needs it once a day, a service would also be right.",
    ),
    (
        "A new turtle is put into a simulator, and its name must be free.",
        "a service",
        "It happens once, the server can refuse it, and the response contains the name of the turtle.",
    ),
    (
        "Every node reports what it does, for a log that a person may read later.",
        "a topic",
        "Many nodes send reports, and none of them should wait for the log. ROS uses the topic `/rosout` "
        "for this.",
    ),
    (
        "The robot drives to the kitchen, which takes two minutes, and may be called back on its way.",
        "an action",
        "The client of a service would wait for two minutes, without progress messages and without a way "
        "to cancel. An action has all three: a goal, progress messages and a result.",
    ),
)
