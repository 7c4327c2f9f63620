"""The graph of `course lab` and `course run`: a ROS master in a private network that commands can join.

Each command uses `graph.py`. `graph.py` starts `holder.py`. This process owns the network and the master
until the last command has left the graph. `network.py` creates the private network, `outgoing.py` connects
this network with other computers, and `kernels.py` starts the kernels of JupyterLab in this network.
`notes.py` returns a message about the limits of the graph.
"""
