"""Goals of actions."""


def send(client, goal, **callbacks):
    """Sends a goal. A SimpleActionClient drops an answer that comes before it has noted the goal; so the answer waits."""
    with client.action_client.manager.list_mutex:
        client.send_goal(goal, **callbacks)
