"""Words of furniture in eight languages, each with its English word.

A row is an English word (or a phrase, `top panel`) and the words that mean it; `;` parts rows. Latin words stand
without accents, as `grafu.asset.names.plain` writes them; umlauts also as `ue`. Words that mean several things are left
out unless one is meant nearly always. What names lids and tops of cases alike is a `coverplate` (`lid_names`).
"""

import re
from typing import Final

# English words that the grammar knows and that stand in compounds too (`glassdoor`).
ENGLISH: Final = """
    door doors drawer drawers handle knob shelf shelves shelving hinge panel board frame front back rear side top bottom
    left right upper lower middle center centre inner outer case cabinet carcass corpus body cupboard wardrobe dresser
    desk table bench unit chest counter bookcase sideboard kitchen fridge freezer oven stove microwave dishwasher sink
    basin glass window mirror leg foot feet base plinth pull grip rail runner slide slider lid flap tray rack divider
    partition stile mullion wall plate floor stair stairs bed bedside nightstand bedroom doorframe doorjamb
"""

GERMAN: Final = """
    door: tur tuer turblatt tuerblatt
    doors: turen tueren
    sliding door: schiebetur schiebetuer schiebeturen
    flap: klappe klappen klappdeckel truhendeckel; coverplate: deckel
    drawer: schublade schubkasten auszug schub
    drawers: schubladen schubkaesten
    handle: griff griffe griffleiste bugelgriff stangengriff
    knob: knopf mobelknopf
    top panel: deckplatte oberboden abdeckplatte deckelplatte
    tabletop: tischplatte arbeitsplatte schreibtischplatte
    bottom panel: unterboden bodenplatte
    back panel: ruckwand rueckwand
    side panel: seitenwand seitenteil seitenplatte wange
    shelf support: bodentrager regalbodentrager
    shelf: einlegeboden fachboden regalboden ablage ablageboden
    divider: trennwand mittelwand zwischenwand mittelseite
    leg: bein beine tischbein fuss fuesse fusse stellfuss
    hinge: scharnier scharniere topfband
    rail: schiene schienen fuhrungsschiene laufschiene
    toe kick: sockel sockelblende sockelleiste
    panel: blende platte paneel; filler panel: passblende passleiste
    wall: wand
    side: seite seiten
    floor: boden
    frame: rahmen
    bar: leiste strebe stange querstrebe steg traverse
    cabinet: schrank schranke kleiderschrank hangeschrank unterschrank kommode vitrine anrichte
    carcass: korpus gehause gehaeuse
    bookcase: regal
    table: tisch
    desk: schreibtisch
    bed: bett
    kitchen: kuche kueche
    oven: ofen backofen; stove: herd; fridge: kuhlschrank kuehlschrank kuhlgefrierkombination
    freezer: gefrierschrank gefrierfach; microwave: mikrowelle
    dishwasher: spulmaschine spuelmaschine geschirrspuler geschirrspueler; washer: waschmaschine
    sink: spule spuele waschbecken
    mirror: spiegel
    glass: glas scheibe
    screw: schraube schrauben
    wheel: rolle rollen rad
    lock: schloss
    front: front vorderseite; left: links linke linker linkes; right: rechts rechte rechter rechtes
    upper: oben obere oberer oberes ober; lower: unten untere unterer unteres unter
    middle: mitte mittlere mittlerer mittleres mittel; front: vorne vordere vorderer vorder
    rear: hinten hintere hinterer hinter; of: von vom fur der des im am mit
"""

FRENCH: Final = """
    door: porte vantail battant
    doors: portes vantaux battants
    flap: abattant
    lid: couvercle
    drawer: tiroir
    drawers: tiroirs
    handle: poignee poignees
    knob: bouton boutons
    top panel: dessus
    shelf: etagere etageres tablette tablettes
    divider: cloison separation
    leg: pied pieds
    hinge: charniere charnieres
    rail: glissiere glissieres coulisse coulisses
    stile: montant montants
    toe kick: socle plinthe
    panel: panneau panneaux
    side: cote cotes joue joues; base: fond
    frame: cadre
    bar: barre barres
    cabinet: armoire meuble placard commode buffet
    carcass: caisson
    desk: bureau
    bed: lit
    kitchen: cuisine
    oven: four; stove: cuisiniere; fridge: frigo refrigerateur; freezer: congelateur; dishwasher: vaisselle
    sink: evier lavabo
    mirror: miroir
    glass: vitre vitres verre
    wheel: roulette roulettes
    lock: serrure
    front: facade facades; sliding: coulissant coulissante coulissantes; left: gauche
    right: droite droit; upper: haut haute superieur superieure
    lower: bas basse inferieur inferieure; middle: milieu central centrale; front: avant
    back: arriere; lateral: lateral laterale; of: de du des la le les en pour sur avec
"""

SPANISH: Final = """
    door: puerta
    doors: puertas
    drawer: cajon gaveta
    drawers: cajones gavetas
    handle: tirador tiradores manija manijas asa asas jaladera agarradera
    knob: pomo pomos perilla
    tabletop: encimera
    shelf: estante estantes balda baldas repisa repisas entrepano
    divider: separador divisor
    leg: pata patas
    hinge: bisagra bisagras
    rail: riel rieles corredera correderas guia
    toe kick: zocalo
    board: tablero tabla; panel: tapa tapas
    side: costado; base: fondo
    bracket: portaestante portaestantes
    frame: marco
    bar: barra barras travesano
    cabinet: armario armarios mueble gabinete comoda aparador
    table: mesa
    desk: escritorio
    bed: cama
    kitchen: cocina
    oven: horno; stove: estufa; fridge: nevera frigorifico refrigerador heladera; freezer: congelador
    microwave: microondas; dishwasher: lavavajillas; washer: lavadora
    sink: fregadero lavabo
    mirror: espejo
    glass: vidrio cristal
    screw: tornillo tornillos
    wheel: rueda ruedas
    lock: cerradura
    sliding: corrediza corredizo corredera; left: izquierda izquierdo izq
    right: derecha derecho der; upper: arriba; lower: abajo; middle: medio; front: frente frontal
    front: delantero delantera; back: trasera trasero; of: del los las el para con
"""

ITALIAN: Final = """
    door: anta sportello
    doors: ante sportelli
    flap: ribalta
    lid: coperchio
    drawer: cassetto
    drawers: cassetti
    handle: maniglia maniglie
    knob: pomello pomelli
    shelf: ripiano ripiani mensola mensole
    divider: divisorio
    leg: gamba gambe piede piedi piedino piedini
    hinge: cerniera cerniere
    rail: binario binari guida guide
    back panel: schienale
    side panel: fianco fianchi fiancata fiancate
    panel: pannello pannelli
    toe kick: zoccolo
    frame: telaio cornice
    cabinet: armadio armadi mobile credenza cassettiera comodino
    table: tavolo tavola
    desk: scrivania
    bed: letto
    kitchen: cucina
    oven: forno; fridge: frigorifero frigo; freezer: congelatore; microwave: microonde; dishwasher: lavastoviglie
    washer: lavatrice
    sink: lavello lavandino
    mirror: specchio
    glass: vetro vetri
    screw: vite viti
    wheel: ruota ruote
    lock: serratura
    front: frontale frontalino; sliding: scorrevole scorrevoli; left: sinistra sinistro sx
    right: destra destro dx; upper: alto alta superiore; lower: basso bassa inferiore
    middle: centrale; front: anteriore; back: posteriore retro; lateral: laterale
    of: di della dello degli dei per
    side: sponda sponde
    bracket: reggipiano reggipiani
"""

PORTUGUESE: Final = """
    door: porta
    doors: portas
    drawer: gaveta gavetao
    drawers: gavetas
    handle: puxador puxadores macaneta
    lid: tampa
    tabletop: tampo bancada
    shelf: prateleira prateleiras
    divider: divisoria
    leg: perna pernas
    hinge: dobradica dobradicas
    rail: trilho trilhos corredica corredicas
    toe kick: rodape
    panel: painel paineis
    frame: moldura
    cabinet: movel
    desk: escrivaninha
    kitchen: cozinha
    stove: fogao; fridge: geladeira frigorifico
    mirror: espelho
    glass: vidro
    screw: parafuso parafusos
    wheel: roda rodas
    lock: fechadura
    back: fundo traseira costas; left: esquerda esquerdo; right: direita direito
    upper: cima superior; lower: baixo inferior; middle: meio; of: da do das dos
"""

CHINESE: Final = """
    door: 门 門 柜门 櫃門 门板 門板 门扇
    sliding door: 移门 推拉门 趟门
    flap: 翻门 上翻门
    lid: 盖 盖子 蓋
    drawer: 抽屉 抽屜 抽
    handle: 把手 拉手 手柄
    top panel: 顶板 頂板 台面 檯面
    tabletop: 桌面
    bottom panel: 底板
    back panel: 背板 后板
    side panel: 侧板 側板 旁板
    shelf: 层板 層板 搁板 隔层 架
    divider: 隔板 中隔板 竖隔板
    leg: 腿 脚 腳 柜脚 桌腿
    hinge: 铰链 鉸鏈 合页
    rail: 滑轨 导轨 滑軌 轨道
    toe kick: 踢脚板 踢脚线
    frame: 框 边框 门框
    bar: 横梁 横杆 杆
    cabinet: 柜 柜子 櫃 橱 衣柜 书柜 电视柜 橱柜 床头柜
    carcass: 柜体 箱体 主体
    table: 桌 桌子
    desk: 书桌 办公桌
    bed: 床
    kitchen: 厨房
    oven: 烤箱; fridge: 冰箱; microwave: 微波炉; dishwasher: 洗碗机; washer: 洗衣机
    sink: 水槽 洗手盆
    mirror: 镜子 镜 鏡
    glass: 玻璃
    screw: 螺丝 螺钉; coverplate: 盖板
    wheel: 轮 轮子 滚轮
    lock: 锁
    front: 面板 前板 前脸; left: 左; right: 右; upper: 上; lower: 下; middle: 中; front: 前; back: 后 後; of: 的
"""

JAPANESE: Final = """
    door: 扉 ドア 戸
    sliding door: 引き戸 引戸
    lid: 蓋 ふた フタ
    drawer: 引き出し 引出し 引出 ひきだし 抽斗
    handle: 取っ手 取手 把手 ハンドル
    knob: つまみ ツマミ ノブ
    top panel: 天板
    bottom panel: 底板 地板
    back panel: 背板
    side panel: 側板
    shelf: 棚 棚板
    divider: 仕切り 仕切板 仕切
    leg: 脚 足
    hinge: 蝶番 丁番 ヒンジ
    rail: レール
    toe kick: 幅木 台輪
    panel: パネル
    frame: 枠 フレーム
    cabinet: キャビネット 戸棚 食器棚 箪笥 タンス クローゼット
    carcass: 本体
    desk: 机 デスク
    table: テーブル
    bed: ベッド
    oven: オーブン; fridge: 冷蔵庫; microwave: 電子レンジ; dishwasher: 食洗機; washer: 洗濯機
    mirror: 鏡
    glass: ガラス
    screw: ネジ ねじ
    wheel: キャスター 車輪
    front: 前板; left: 左; right: 右; upper: 上; lower: 下; middle: 中; front: 前; back: 後 後ろ; of: の
"""

ROMANCE: Final = (FRENCH, SPANISH, ITALIAN, PORTUGUESE)
"""Languages whose head noun comes first: `porte gauche`, `tirador de la puerta`."""
HEAD_LAST: Final = (GERMAN, CHINESE, JAPANESE)
"""Languages whose head noun comes last, as in English: `Schubladengriff`, `抽屉把手`."""


def table(*languages: str) -> dict[str, tuple[str, ...]]:
    """Returns the English words that each word of the languages means; the first row that has it counts."""
    found: dict[str, tuple[str, ...]] = {}
    for row in re.split(r"[;\n]", "\n".join(languages)):
        english, _, words = row.partition(":")
        for word in words.split():
            found.setdefault(word, tuple(english.split()))
    return found


def word_set(text: str) -> frozenset[str]:
    """Returns the words of a text that spaces part."""
    return frozenset(text.split())
