"""What students answer in chapter 10; see answers.py for the form of this file."""

# %% before
import threading
import time
import uuid

import rosgraph
import rospy
from course_pkg import join
from course_pkg.errors import CallTimeout
from course_pkg.srv import Charge, ChargeResponse
from std_srvs.srv import Trigger, TriggerResponse

node = join("chapter_10")

# %% 10.1 right: with
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf
        self.lock = threading.Lock()

    def handle_take(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        return TriggerResponse(success=True, message=str(count - 1))

# %% 10.1 right: acquire and release, one lock for all
class Stock:
    everybody = threading.RLock()

    def __init__(self, shelf):
        self.shelf = shelf

    def handle_take(self, request):
        Stock.everybody.acquire()
        try:
            if self.shelf.read() <= 0:
                return False, "sold out"
            left = self.shelf.read() - 1
            self.shelf.write(left)
            return True, str(left)
        finally:
            Stock.everybody.release()

# %% 10.1 wrong: no lock | hint: Two callers read the same number
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf

    def handle_take(self, request):
        count = self.shelf.read()
        if count == 0:
            return TriggerResponse(success=False, message="sold out")
        self.shelf.write(count - 1)
        return TriggerResponse(success=True, message=str(count - 1))

# %% 10.1 wrong: a lock for each call | hint: which is the same for all callers
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf

    def handle_take(self, request):
        with threading.Lock():
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
            return TriggerResponse(success=True, message=str(count - 1))

# %% 10.1 wrong: locks the writing only | hint: Reading, deciding and writing belong under one lock
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf
        self.lock = threading.Lock()

    def handle_take(self, request):
        count = self.shelf.read()
        if count == 0:
            return TriggerResponse(success=False, message="sold out")
        with self.lock:
            self.shelf.write(count - 1)
        return TriggerResponse(success=True, message=str(count - 1))

# %% 10.1 wrong: keeps the lock when sold out | hint: somebody took the lock and never gave it back
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf
        self.lock = threading.Lock()

    def handle_take(self, request):
        self.lock.acquire()
        count = self.shelf.read()
        if count == 0:
            return TriggerResponse(success=False, message="sold out")
        self.shelf.write(count - 1)
        self.lock.release()
        return TriggerResponse(success=True, message=str(count - 1))

# %% 10.1 wrong: takes the lock twice | hint: who holds it must not take it once more
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf
        self.lock = threading.Lock()

    def left(self):
        with self.lock:
            return self.shelf.read()

    def handle_take(self, request):
        with self.lock:
            count = self.left()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        return TriggerResponse(success=True, message=str(count - 1))

# %% 10.1 wrong: turns away who finds the lock taken | hint: Somebody was turned away while there was something left
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf
        self.lock = threading.Lock()

    def handle_take(self, request):
        if not self.lock.acquire(blocking=False):
            return TriggerResponse(success=False, message="busy")
        try:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
            return TriggerResponse(success=True, message=str(count - 1))
        finally:
            self.lock.release()

# %% 10.1 wrong: sells what is not there | hint: Look before you take
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf
        self.lock = threading.Lock()

    def handle_take(self, request):
        with self.lock:
            count = self.shelf.read() - 1
            self.shelf.write(count)
        return TriggerResponse(success=True, message=str(count))

# %% 10.1 wrong: says how many there were | hint: That is how many there were
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf
        self.lock = threading.Lock()

    def handle_take(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        return TriggerResponse(success=True, message=str(count))

# %% 10.1 wrong: leaves the shelf as it was | hint: Write to the shelf how many are left
class Stock:
    def __init__(self, shelf):
        self.count = shelf.read()
        self.lock = threading.Lock()

    def handle_take(self, request):
        with self.lock:
            if self.count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.count -= 1
            return TriggerResponse(success=True, message=str(self.count))

# %% 10.1 wrong: sold out as an error | hint: Sold out is an ordinary answer
class Stock:
    def __init__(self, shelf):
        self.shelf, self.lock = shelf, threading.Lock()
    def handle_take(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                raise rospy.ServiceException("sold out")
            self.shelf.write(count - 1)
        return TriggerResponse(success=True, message=str(count - 1))

# %% 10.1 wrong: a number for a message | hint: The message is text
class Stock:
    def __init__(self, shelf):
        self.shelf, self.lock = shelf, threading.Lock()
    def handle_take(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        return TriggerResponse(success=True, message=count - 1)

# %% 10.1 wrong: reads under the lock, writes outside | hint: under one lock
class Stock:
    def __init__(self, shelf):
        self.shelf, self.lock = shelf, threading.Lock()
    def handle_take(self, request):
        with self.lock:
            count = self.shelf.read()
        if count == 0:
            return TriggerResponse(success=False, message="sold out")
        self.shelf.write(count - 1)
        return TriggerResponse(success=True, message=str(count - 1))

# %% 10.2 right: reserve, pay, put back
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf = shelf
        self.cents = cents
        self.till = till
        self.lock = threading.Lock()

    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))

    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        try:
            receipt = node.call(self.till, Charge, str(uuid.uuid4()), self.cents).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            with self.lock:
                self.shelf.write(self.shelf.read() + 1)
            return TriggerResponse(success=False, message=f"not paid: {error}")
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 right: changes in a method of its own
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents = shelf, cents
        self.pay = rospy.ServiceProxy(till, Charge)
        self.lock = threading.Lock()
        self.number = 0

    def change(self, by):
        with self.lock:
            count = self.shelf.read() + by
            if count < 0:
                return None
            self.shelf.write(count)
            self.number += 1
            return self.number

    def handle_left(self, request):
        return True, str(self.shelf.read())

    def handle_buy(self, request):
        number = self.change(-1)
        if number is None:
            return False, "sold out"
        try:
            answer = self.pay(request_id=f"{id(self)}-{number}", cents=self.cents)
        except rospy.ServiceException as error:
            self.change(+1)
            return False, str(error)
        return True, str(answer.receipt)

# %% 10.2 wrong: holds the lock across the call | hint: the lock is held across the call
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()

    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))

    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            try:
                receipt = node.call(self.till, Charge, str(uuid.uuid4()), self.cents).receipt
            except (rospy.ServiceException, CallTimeout):
                return TriggerResponse(success=False, message="not paid")
            self.shelf.write(count - 1)
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: takes it only after it was paid | hint: Take it from the shelf first
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()

    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))

    def handle_buy(self, request):
        with self.lock:
            if self.shelf.read() == 0:
                return TriggerResponse(success=False, message="sold out")
        try:
            receipt = node.call(self.till, Charge, str(uuid.uuid4()), self.cents).receipt
        except (rospy.ServiceException, CallTimeout):
            return TriggerResponse(success=False, message="not paid")
        with self.lock:
            self.shelf.write(self.shelf.read() - 1)
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: puts nothing back | hint: The till failed, and the thing is gone
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()

    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))

    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        try:
            receipt = node.call(self.till, Charge, str(uuid.uuid4()), self.cents).receipt
        except (rospy.ServiceException, CallTimeout):
            return TriggerResponse(success=False, message="not paid")
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: catches nothing | hint: its error came out of the handler
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()

    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))

    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        receipt = node.call(self.till, Charge, str(uuid.uuid4()), self.cents).receipt
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: puts back what it counted before | hint: one of the changes is lost
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()

    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))

    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        try:
            receipt = node.call(self.till, Charge, str(uuid.uuid4()), self.cents).receipt
        except (rospy.ServiceException, CallTimeout):
            time.sleep(0.2)
            self.shelf.write(count)
            return TriggerResponse(success=False, message="not paid")
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: no lock at all | hint: Two changed the shelf at the same time
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till

    def handle_left(self, request):
        return TriggerResponse(success=True, message=str(self.shelf.read()))

    def handle_buy(self, request):
        count = self.shelf.read()
        if count == 0:
            return TriggerResponse(success=False, message="sold out")
        self.shelf.write(count - 1)
        try:
            receipt = node.call(self.till, Charge, str(uuid.uuid4()), self.cents).receipt
        except (rospy.ServiceException, CallTimeout):
            self.shelf.write(self.shelf.read() + 1)
            return TriggerResponse(success=False, message="not paid")
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: one id for all | hint: Make the id in the handler
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()
        self.request_id = str(uuid.uuid4())

    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))

    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        try:
            receipt = node.call(self.till, Charge, self.request_id, self.cents).receipt
        except (rospy.ServiceException, CallTimeout):
            with self.lock:
                self.shelf.write(self.shelf.read() + 1)
            return TriggerResponse(success=False, message="not paid")
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: no id | hint: Make one for each purchase
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()

    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))

    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        receipt = node.call(self.till, Charge, cents=self.cents).receipt
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: another word for sold out | hint: the words sold out
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()
    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))
    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="nothing left")
            self.shelf.write(count - 1)
        try:
            receipt = node.call(self.till, Charge, str(uuid.uuid4()), self.cents).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            with self.lock:
                self.shelf.write(self.shelf.read() + 1)
            return TriggerResponse(success=False, message=str(error))
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: does not say why | hint: Say why
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()
    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))
    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        try:
            receipt = node.call(self.till, Charge, str(uuid.uuid4()), self.cents).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            with self.lock:
                self.shelf.write(self.shelf.read() + 1)
            return TriggerResponse(success=False)
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: tries the till again | hint: was asked again
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()
    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))
    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        request_id = str(uuid.uuid4())
        for _ in range(3):
            try:
                receipt = node.call(self.till, Charge, request_id, self.cents).receipt
                return TriggerResponse(success=True, message=str(receipt))
            except (rospy.ServiceException, CallTimeout) as error:
                why = str(error)
        with self.lock:
            self.shelf.write(self.shelf.read() + 1)
        return TriggerResponse(success=False, message=why)

# %% 10.2 wrong: the id is what is left | hint: Make the id in the handler
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()
    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))
    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        try:
            receipt = node.call(self.till, Charge, f"purchase {count}", self.cents).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            with self.lock:
                self.shelf.write(self.shelf.read() + 1)
            return TriggerResponse(success=False, message=str(error))
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.2 wrong: sold out as an error | hint: Sold out is an ordinary answer
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()
    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))
    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                raise rospy.ServiceException("sold out")
            self.shelf.write(count - 1)
        try:
            receipt = node.call(self.till, Charge, str(uuid.uuid4()), self.cents).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            with self.lock:
                self.shelf.write(self.shelf.read() + 1)
            return TriggerResponse(success=False, message=str(error))
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.3 right: a dict under a lock
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.receipts = {}
        self.lock = threading.Lock()

    def handle_charge(self, request):
        if not request.request_id:
            raise rospy.ServiceException("a request without an id cannot be told from its repeat")
        with self.lock:
            if request.request_id not in self.receipts:
                self.purse.take(request.cents)
                self.receipts[request.request_id] = len(self.receipts) + 1
            return ChargeResponse(receipt=self.receipts[request.request_id])

# %% 10.3 right: whole responses, numbers from a counter
import itertools


class Till:
    def __init__(self, purse):
        self.purse, self.done = purse, {}
        self.numbers = itertools.count(100)
        self.lock = threading.RLock()

    def handle_charge(self, request):
        if request.request_id == "":
            raise rospy.ServiceException("no id")
        with self.lock:
            known = self.done.get(request.request_id)
            if known is None:
                self.purse.take(request.cents)
                known = self.done[request.request_id] = ChargeResponse(next(self.numbers))
        return known

# %% 10.3 right: futures, receipts from 0
from concurrent.futures import Future
class Till:
    def __init__(self, purse):
        self.purse, self.lock = purse, threading.Lock()
        self.under_way, self.count = {}, 0
    def handle_charge(self, request):
        if len(request.request_id) == 0:
            raise rospy.ServiceException("empty id")
        with self.lock:
            first = request.request_id not in self.under_way
            future = self.under_way.setdefault(request.request_id, Future())
        if first:
            try:
                self.purse.take(request.cents)
            except Exception as error:
                with self.lock:
                    del self.under_way[request.request_id]
                future.set_exception(error)
                raise rospy.ServiceException(f"the purse: {error}")
            with self.lock:
                number, self.count = self.count, self.count + 1
            future.set_result(number)
        return {"receipt": future.result()}

# %% 10.3 wrong: charges whatever comes | hint: came again, and was charged again
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.count = 0
        self.lock = threading.Lock()

    def handle_charge(self, request):
        if not request.request_id:
            raise rospy.ServiceException("no id")
        with self.lock:
            self.purse.take(request.cents)
            self.count += 1
            return ChargeResponse(receipt=self.count)

# %% 10.3 wrong: goes by the amount | hint: Two customers may pay the same amount
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.receipts = {}
        self.lock = threading.Lock()

    def handle_charge(self, request):
        with self.lock:
            if request.cents not in self.receipts:
                self.purse.take(request.cents)
                self.receipts[request.cents] = len(self.receipts) + 1
            return ChargeResponse(receipt=self.receipts[request.cents])

# %% 10.3 wrong: remembers that, and not what | hint: The receipt is 0
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.done = set()
        self.lock = threading.Lock()

    def handle_charge(self, request):
        with self.lock:
            if request.request_id in self.done:
                return ChargeResponse()
            self.purse.take(request.cents)
            self.done.add(request.request_id)
            return ChargeResponse(receipt=len(self.done))

# %% 10.3 wrong: a new receipt for a repeat | hint: That is another receipt
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.done = set()
        self.count = 0
        self.lock = threading.Lock()

    def handle_charge(self, request):
        with self.lock:
            if request.request_id not in self.done:
                self.purse.take(request.cents)
                self.done.add(request.request_id)
            self.count += 1
            return ChargeResponse(receipt=self.count)

# %% 10.3 wrong: refuses a repeat | hint: The customer never got the first answer
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.done = set()
        self.lock = threading.Lock()

    def handle_charge(self, request):
        with self.lock:
            if request.request_id in self.done:
                raise rospy.ServiceException("this was charged already")
            self.purse.take(request.cents)
            self.done.add(request.request_id)
            return ChargeResponse(receipt=len(self.done))

# %% 10.3 wrong: remembers first, and takes then | hint: now it counts as done
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.receipts = {}
        self.lock = threading.Lock()

    def handle_charge(self, request):
        if not request.request_id:
            raise rospy.ServiceException("no id")
        with self.lock:
            if request.request_id not in self.receipts:
                self.receipts[request.request_id] = len(self.receipts) + 1
                self.purse.take(request.cents)
            return ChargeResponse(receipt=self.receipts[request.request_id])

# %% 10.3 wrong: takes requests without an id | hint: Without an id nobody can tell a repeat
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.receipts = {}
        self.lock = threading.Lock()

    def handle_charge(self, request):
        with self.lock:
            if request.request_id not in self.receipts:
                self.purse.take(request.cents)
                self.receipts[request.request_id] = len(self.receipts) + 1
            return ChargeResponse(receipt=self.receipts[request.request_id])

# %% 10.3 wrong: no lock | hint: between looking and remembering there was time for another
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.receipts = {}

    def handle_charge(self, request):
        if not request.request_id:
            raise rospy.ServiceException("no id")
        if request.request_id not in self.receipts:
            self.purse.take(request.cents)
            self.receipts[request.request_id] = len(self.receipts) + 1
        return ChargeResponse(receipt=self.receipts[request.request_id])

# %% 10.3 wrong: keeps the lock when the purse fails | hint: Nobody is answered any more after a purse that failed
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.receipts = {}
        self.lock = threading.Lock()

    def handle_charge(self, request):
        if not request.request_id:
            raise rospy.ServiceException("no id")
        self.lock.acquire()
        if request.request_id not in self.receipts:
            self.purse.take(request.cents)
            self.receipts[request.request_id] = len(self.receipts) + 1
        self.lock.release()
        return ChargeResponse(receipt=self.receipts[request.request_id])

# %% 10.3 wrong: hides that the purse failed | hint: The purse raised, and the client got a receipt
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.receipts = {}
        self.lock = threading.Lock()

    def handle_charge(self, request):
        if not request.request_id:
            raise rospy.ServiceException("no id")
        with self.lock:
            if request.request_id not in self.receipts:
                try:
                    self.purse.take(request.cents)
                except RuntimeError:
                    rospy.logwarn("the purse failed")
                self.receipts[request.request_id] = len(self.receipts) + 1
            return ChargeResponse(receipt=self.receipts[request.request_id])

# %% 10.3 wrong: nothing for an empty id | hint: The handler returned nothing
class Till:
    def __init__(self, purse):
        self.purse, self.receipts, self.lock = purse, {}, threading.Lock()
    def handle_charge(self, request):
        if not request.request_id:
            return None
        with self.lock:
            if request.request_id not in self.receipts:
                self.purse.take(request.cents)
                self.receipts[request.request_id] = len(self.receipts) + 1
            return ChargeResponse(receipt=self.receipts[request.request_id])

# %% 10.3 wrong: forgets to return | hint: Return a ChargeResponse
class Till:
    def __init__(self, purse):
        self.purse, self.receipts, self.lock = purse, {}, threading.Lock()
    def handle_charge(self, request):
        if not request.request_id:
            raise rospy.ServiceException("no id")
        with self.lock:
            if request.request_id not in self.receipts:
                self.purse.take(request.cents)
                self.receipts[request.request_id] = len(self.receipts) + 1

# %% 10.4 right: a loop with a clock
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 right: one try as a function, and an id from another source
import secrets


class Failed(Exception):
    pass


def once(ask, request, limit):
    try:
        return ask.call(request, timeout=limit).receipt
    except CallTimeout as error:
        raise Failed from error
    except rospy.ServiceException as error:
        if "service cannot process request" in str(error):
            raise
        raise Failed from error


def pay(till, cents, deadline):
    ask = node.caller(till, Charge)
    request = Charge._request_class(request_id=secrets.token_hex(8), cents=cents)
    begun = time.time()
    for number in range(100):
        left = begun + deadline - time.time()
        if left <= 0:
            break
        try:
            return once(ask, request, min(0.5, left))
        except Failed:
            rospy.sleep(min(0.1 * 2**number, left))

# %% 10.4 right: a generator of pauses, tripled
def pauses():
    pause = 0.1
    while True:
        yield pause
        pause *= 3

def pay(till, cents, deadline):
    request = Charge._request_class(str(uuid.uuid4()), cents)
    over = time.time() + deadline
    for pause in pauses():
        left = over - time.time()
        if left <= 0:
            return None
        try:
            response = node.call(till, Charge, request, timeout=min(left, 0.5))
        except CallTimeout:
            pass
        except rospy.ServiceException as error:
            if "cannot process request" in str(error):
                raise
        else:
            return response.receipt
        time.sleep(max(0, min(pause, over - time.time())))

# %% 10.4 wrong: tries once | hint: One failed try ended everything
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    try:
        return node.call(till, Charge, request_id, cents, timeout=min(0.5, deadline)).receipt
    except CallTimeout:
        return None

# %% 10.4 wrong: a new id for each try | hint: Every try had an id of its own
def pay(till, cents, deadline):
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, str(uuid.uuid4()), cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: one id for all payments | hint: Two payments, one id
request_id = str(uuid.uuid4())


def pay(till, cents, deadline):
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: no id | hint: Make one for each payment
def pay(till, cents, deadline):
    end = time.monotonic() + deadline
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, cents=cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout):
            time.sleep(0.1)
    return None

# %% 10.4 wrong: repeats a refusal | hint: The till had decided, and was asked again
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout):
            time.sleep(min(pause, max(end - time.monotonic(), 0)))
            pause *= 2
    return None

# %% 10.4 wrong: None for a refusal | hint: The till refused, and nobody hears of it
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                return None
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: the whole deadline for the first try | hint: The first try took all the time there was
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=rest).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: a proxy without a limit | hint: rospy has no limit
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while time.monotonic() < end:
        try:
            return rospy.ServiceProxy(till, Charge)(request_id, cents).receipt
        except rospy.ServiceException as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(pause)
        pause *= 2
    return None

# %% 10.4 wrong: does not catch the limit | hint: CallTimeout ended everything
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except rospy.ServiceException as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: takes every error for a refusal | hint: One failed try ended everything
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except CallTimeout:
            pass
        except rospy.ServiceException as error:
            if "request" in str(error) or "error" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: twice and no more | hint: you had given up
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    for _ in range(2):
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, deadline)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(0.1)
    return None

# %% 10.4 wrong: no pause | hint: is not helped by a thousand questions a second
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end = time.monotonic() + deadline
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
    return None

# %% 10.4 wrong: always the same pause | hint: Double the pause after each try that failed
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end = time.monotonic() + deadline
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(0.1)
    return None

# %% 10.4 wrong: two seconds for a try | hint: had more
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(2, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: a tenth of a second for a try | hint: had less
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.1, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: half a second, whatever is left | hint: no more than what is left
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while time.monotonic() < end:
        try:
            return node.call(till, Charge, request_id, cents, timeout=0.5).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: adds to the pause | hint: Double the pause
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause += 0.1
    return None

# %% 10.4 wrong: begins with a shorter pause | hint: time.sleep(pause) after a try that failed
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.05
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: five times | hint: you had given up
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    for _ in range(5):
        rest = end - time.monotonic()
        if rest <= 0:
            break
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 10.4 wrong: counts the pauses only | hint: It went on after the deadline
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    waited, pause = 0, 0.1
    while waited < deadline:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, deadline)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(pause)
        waited += pause
        pause *= 2
    return None

# %% 10.4 wrong: raises when the deadline has passed | hint: raise nothing
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return node.call(till, Charge, request_id, cents, timeout=min(0.5, rest)).receipt
        except (rospy.ServiceException, CallTimeout) as error:
            if "cannot process request" in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    raise CallTimeout("nobody knows")

# %% 10.5 right: a lock between look and stop
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.lock = threading.Lock()
        self.over = threading.Event()
        threading.Thread(target=self.run, daemon=True).start()

    def run(self):
        while not self.over.wait(self.every):
            try:
                self.look()
            except (OSError, rosgraph.MasterException):
                continue

    def look(self):
        with self.lock:
            if self.over.is_set():
                return
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                self.master.registerService(self.service, self.uri, rospy.get_node_uri())

    def stop(self):
        with self.lock:
            self.over.set()

# %% 10.5 right: a thread that is joined
class Watchdog(threading.Thread):
    def __init__(self, name, uri, master, every):
        super().__init__(daemon=True)
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.going = True
        self.start()

    def run(self):
        while self.going:
            try:
                if self.service not in self.served():
                    self.master.registerService(self.service, self.uri, rospy.get_node_uri())
            except Exception as error:
                rospy.logdebug(error)
            time.sleep(self.every)

    def served(self):
        try:
            self.master.lookupService(self.service)
        except rosgraph.MasterError:
            return []
        return [self.service]

    def stop(self):
        self.going = False
        self.join()

# %% 10.5 right: by the state of the system
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.name, self.uri, self.master, self.every = name, uri, master, every
        self.alive, self.lock = True, threading.Lock()
        self.thread = threading.Thread(target=self.watch, daemon=True)
        self.thread.start()
    def watch(self):
        while self.alive:
            with self.lock:
                if self.alive:
                    try:
                        publishers, subscribers, services = self.master.getSystemState()
                        if self.name not in dict(services):
                            self.master.registerService(self.name, self.uri, rospy.get_node_uri())
                    except Exception as error:
                        print(error)
            time.sleep(self.every)
    def stop(self):
        with self.lock:
            self.alive = False

# %% 10.5 right: over the handle, is_online first, rate
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.name, self.uri, self.master = name, uri, master
        self.rate = rospy.Rate(1 / every)
        self.quit = threading.Event()
        self.done = threading.Event()
        threading.Thread(target=self.loop, daemon=True).start()
    def loop(self):
        try:
            while not self.quit.is_set():
                if self.master.is_online():
                    try:
                        code, _, _ = self.master.handle.lookupService(self.master.caller_id, self.name)
                        if code != 1:
                            self.master.registerService(self.name, self.uri, rospy.get_node_uri())
                    except OSError:
                        pass
                self.rate.sleep()
        finally:
            self.done.set()
    def stop(self):
        self.quit.set()
        self.done.wait()

# %% 10.5 wrong: looks once | hint: is not told
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.master = name, master
        try:
            master.lookupService(name)
        except rosgraph.MasterError:
            pass

    def stop(self):
        pass

# %% 10.5 wrong: registers once | hint: that ended the watchdog's thread
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        while not self.over.wait(self.every):
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                self.master.registerService(self.service, self.uri, rospy.get_node_uri())

    def stop(self):
        self.over.set()
        self.thread.join()

# %% 10.5 wrong: loops in __init__ | hint: belongs on a thread of its own
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.over = False
        while not self.over:
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                self.master.registerService(self.service, self.uri, rospy.get_node_uri())
            except OSError:
                pass
            time.sleep(every)

    def stop(self):
        self.over = True

# %% 10.5 wrong: the addresses mixed up | hint: The address of a service begins with rosrpc
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        while not self.over.wait(self.every):
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                self.master.registerService(self.service, rospy.get_node_uri(), self.uri)
            except OSError:
                continue

    def stop(self):
        self.over.set()
        self.thread.join()

# %% 10.5 wrong: takes the name back | hint: they would fight for ever
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def known(self):
        try:
            return self.master.lookupService(self.service) == self.uri
        except rosgraph.MasterError:
            return False

    def run(self):
        while not self.over.wait(self.every):
            try:
                if not self.known():
                    self.master.registerService(self.service, self.uri, rospy.get_node_uri())
            except (OSError, rosgraph.MasterException):
                continue

    def stop(self):
        self.over.set()
        self.thread.join()

# %% 10.5 wrong: registers at every look | hint: Look it up first
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        while not self.over.wait(self.every):
            try:
                self.master.registerService(self.service, self.uri, rospy.get_node_uri())
            except (OSError, rosgraph.MasterException):
                continue

    def stop(self):
        self.over.set()
        self.thread.join()

# %% 10.5 wrong: stops in the middle of a look | hint: stop() returned in the middle of a look
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.over = threading.Event()
        threading.Thread(target=self.run, daemon=True).start()

    def run(self):
        while not self.over.wait(self.every):
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                self.master.registerService(self.service, self.uri, rospy.get_node_uri())
            except OSError:
                continue

    def stop(self):
        self.over.set()

# %% 10.5 wrong: holds the lock all the time | hint: stop() waits for itself
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.lock = threading.Lock()
        self.over = False
        threading.Thread(target=self.run, daemon=True).start()

    def run(self):
        with self.lock:
            while not self.over:
                try:
                    self.master.lookupService(self.service)
                except rosgraph.MasterError:
                    self.master.registerService(self.service, self.uri, rospy.get_node_uri())
                except OSError:
                    pass
                time.sleep(self.every)

    def stop(self):
        with self.lock:
            self.over = True

# %% 10.5 wrong: asks the kernel's own master | hint: The master that it was given was never asked
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, rosgraph.Master(rospy.get_name()), every
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()
    def run(self):
        while not self.over.wait(self.every):
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                self.master.registerService(self.service, self.uri, rospy.get_node_uri())
            except OSError:
                continue
    def stop(self):
        self.over.set()
        self.thread.join()

# %% 10.5 wrong: looks without a pause | hint: there is no pause
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()
    def run(self):
        while not self.over.is_set():
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                self.master.registerService(self.service, self.uri, rospy.get_node_uri())
            except OSError:
                continue
    def stop(self):
        self.over.set()
        self.thread.join()

# %% 10.5 wrong: no pause after a look that failed | hint: also after a look that failed
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()
    def run(self):
        while not self.over.is_set():
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                self.master.registerService(self.service, self.uri, rospy.get_node_uri())
            except OSError:
                continue
            time.sleep(self.every)
    def stop(self):
        self.over.set()
        self.thread.join()

# %% 10.5 wrong: looks at a flag before it registers | hint: stop() returned in the middle of a look
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.over = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()
    def run(self):
        while not self.over.wait(self.every):
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                if not self.over.is_set():
                    self.master.registerService(self.service, self.uri, rospy.get_node_uri())
            except OSError:
                continue
    def stop(self):
        self.over.set()

# %% 10.6 right: one after the other
diagnosis = {
    "A": "killed",
    "B": "new master",
    "C": "frozen",
    "D": "lock",
    "E": "race",
    "F": "repeated",
    "G": "two providers",
}

# %% 10.6 right: in another order
diagnosis = dict(G="two providers", F="repeated", E="race", D="lock")
diagnosis |= dict(zip("ABC", ["killed", "new master", "frozen"]))

# %% 10.6 wrong: A and C exchanged | hint: at the address that they give nobody takes a connection
diagnosis = {
    "A": "frozen",
    "B": "new master",
    "C": "killed",
    "D": "lock",
    "E": "race",
    "F": "repeated",
    "G": "two providers",
}

# %% 10.6 wrong: a new master taken for a killed server | hint: Only who has to look the name up is turned away
diagnosis = {
    "A": "killed",
    "B": "killed",
    "C": "frozen",
    "D": "lock",
    "E": "race",
    "F": "repeated",
    "G": "two providers",
}

# %% 10.6 wrong: a lock taken for a frozen process | hint: what rospy serves by itself answers
diagnosis = {
    "A": "killed",
    "B": "new master",
    "C": "frozen",
    "D": "frozen",
    "E": "race",
    "F": "repeated",
    "G": "two providers",
}

# %% 10.6 wrong: a frozen process taken for a lock | hint: not even what rospy serves by itself
diagnosis = {
    "A": "killed",
    "B": "new master",
    "C": "lock",
    "D": "lock",
    "E": "race",
    "F": "repeated",
    "G": "two providers",
}

# %% 10.6 wrong: a repeat taken for a race | hint: only its answer was lost
diagnosis = {
    "A": "killed",
    "B": "new master",
    "C": "frozen",
    "D": "lock",
    "E": "race",
    "F": "race",
    "G": "two providers",
}

# %% 10.6 wrong: a case left out | hint: each letter of the table is a key
diagnosis = {"A": "killed", "B": "new master", "C": "frozen", "D": "lock", "E": "race", "F": "repeated"}

# %% 10.6 wrong: words of one's own | hint: Take the words of the list of causes
diagnosis = {
    "A": "the server was killed",
    "B": "new master",
    "C": "frozen",
    "D": "lock",
    "E": "race",
    "F": "repeated",
    "G": "two providers",
}

# %% 10.6 wrong: sets | hint: Take the words of the list of causes
diagnosis = {"A": {"killed"}, "B": {"new master"}, "C": {"frozen"}, "D": {"lock"}, "E": {"race"}, "F": {"repeated"}, "G": {"two providers"}}
