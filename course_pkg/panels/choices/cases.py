"""The default cases of choose(): in each situation, a topic, a service or an action is best."""

from __future__ import annotations

QUESTION = "Which way of communication fits best?"

OPTIONS = ("a topic", "a service", "an action")

CASES: tuple[tuple[str, str, str], ...] = (
    (
        "A simulator mirrors the joints of an arm, which moves all the time.",
        "a topic",
        "New joint states come every 50 ms, and only the newest joint states are needed. With "
        "a service, the simulator would make twenty calls per second and wait for each "
        "response.",
    ),
    (
        "A lamp is switched on, and the program continues only when the lamp is on.",
        "a service",
        "The program needs to know that the lamp is on, or why it is off. With a topic, the "
        "program would get no response.",
    ),
    (
        "A camera sends pictures to a program that keeps the robot from hitting obstacles.",
        "a topic",
        "The program needs each picture immediately. If one picture is lost, the next picture "
        "comes 33 ms later; if no picture comes for half a second, the robot stops.",
    ),
    (
        "A web page shows a picture of the shop. It shows a new picture every hour.",
        "a service",
        "A picture is large, and the page needs one picture per hour. With a topic, the camera "
        "would send a hundred thousand pictures for each picture that the page shows.",
    ),
    (
        "A planner computes a path through the room when the robot has to go somewhere.",
        "a service",
        "The request contains a start and a goal, and the response contains the path for this "
        "client. If the planner needed a minute, an action would be better.",
    ),
    (
        "An emergency stop: a person presses a button, and every motor has to stop.",
        "a topic",
        "Experts do not agree about this case. With a service, a client would call one motor "
        "after the other, and one motor without a response would delay the others. With a "
        "topic, all motors get the message at the same time. In a safe design, a node "
        "publishes *all is well* ten times per second, and a motor that receives nothing "
        "stops. A real button also cuts the power.",
    ),
    (
        "A display, the log, and a program that drives to the charger need the battery level.",
        "a topic",
        "Several nodes need the level, and the publisher does not have to know these nodes. "
        "The level changes slowly, so one latched message in ten seconds is enough. If only "
        "one client needs the level once a day, a service is also right.",
    ),
    (
        "A new turtle is put into a simulator, and its name must be free.",
        "a service",
        "A turtle is created only once, the server can refuse the request, and the response "
        "contains the name of the turtle.",
    ),
    (
        "Every node reports what it does, for a log that a person may read later.",
        "a topic",
        "Many nodes send reports, and none of these nodes should wait for the log. ROS uses "
        "the topic `/rosout` for this purpose.",
    ),
    (
        "A robot drives to the kitchen, which takes two minutes. A user can cancel this drive.",
        "an action",
        "With a service, the client would wait for two minutes without progress messages, and "
        "it could not cancel the job. An action has a goal, progress messages and a result, "
        "and the client can cancel it.",
    ),
)
