model rolling sphere
state p = 0
der(p) = 0
